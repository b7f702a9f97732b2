// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/quality/masking_budget.h"

#include <epoxy/gl.h>

#include <optional>

#include "experiments/base/error.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/frame/shaded.h"
#include "renderer/techniques/soft_shadows/quality/budget_range.h"

namespace limen::techniques {
namespace {

const char* const kMaskingShader = "renderer/techniques/soft_shadows/quality/masking_budget.comp.glsl";
const char* const kMaskingPass = "soft_shadows/budget_map";

class MaskingBudget : public BudgetDriver {
 public:
  explicit MaskingBudget(const ParameterValues& values)
      : range_(BudgetRange::of(values, "masking")),
        radius_(static_cast<int>(values.integer("masking_radius"))),
        lowContrast_(values.real("masking_low_contrast")),
        highContrast_(values.real("masking_high_contrast")) {
    // Albedo by cosine: contrasts of the light's part alone, whatever the scene's brightness.
    picture_.ambient = 0.0;
    picture_.diffuse = 1.0;
    picture_.background = 0.0;
  }

  void prepare(frame::Frame& frame) override {
    rows_.emplace(gl::Format::RGBA32F, frame.sizePx());
    map_.emplace(gl::Format::R32F, frame.sizePx());
    frame.passes().setBytesHeld(kMaskingPass, rows_->bytes() + map_->bytes());
    rowsOf_ = &frame.context().programs().compute(kMaskingShader, {{"ROWS", "1"}});
    budgetOf_ = &frame.context().programs().compute(kMaskingShader);
  }

  const gl::Texture& make(frame::Frame& frame) override {
    const gl::Texture& picture = frame.get<frame::Shaded>(picture_).texture();
    const gl::Texture& receivers = frame.get<frame::Receivers>().texture();
    const auto scope = frame.passes().open(kMaskingPass);
    rowsOf_->set("sizePx", frame.sizePx());
    rowsOf_->set("radius", radius_);
    picture.bindTexture(0);
    receivers.bindTexture(1);
    rows_->bindImage(0, gl::Access::Write);
    rowsOf_->dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    budgetOf_->set("sizePx", frame.sizePx());
    budgetOf_->set("radius", radius_);
    budgetOf_->set("lowContrast", static_cast<float>(lowContrast_));
    budgetOf_->set("highContrast", static_cast<float>(highContrast_));
    range_.configure(*budgetOf_);
    rows_->bindTexture(0);
    map_->bindImage(0, gl::Access::Write);
    budgetOf_->dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    return *map_;
  }

 private:
  BudgetRange range_;
  int radius_;
  double lowContrast_, highContrast_;
  frame::ShadedSetting picture_;
  std::optional<gl::Texture> rows_, map_;
  const gl::Program *rowsOf_ = nullptr, *budgetOf_ = nullptr;
};

void checkMaskingBudget(const ParameterValues& values) {
  BudgetRange::check(values, "masking");
  if (values.real("masking_low_contrast") >= values.real("masking_high_contrast"))
    throw Error("'masking_high_contrast' is not above 'masking_low_contrast'", "masking_high_contrast",
                "give it a larger contrast than 'masking_low_contrast'");
}

}  // namespace

BudgetDriverInfo maskingBudgetInfo() {
  const char* open = "Schwarz 2009, section 5.2.3 (open there)";
  return {.name = "masking",
          .parameters = {BudgetRange::parameter("masking",
                                                "where texture masks most; 'budget' is for plain surfaces",
                                                "Schwarz 2009, figure 5.4"),
                         integerParameter("masking_radius", 8, 1, 64, "px",
                                          "Reach of the square window in which contrast is measured", open),
                         realParameter("masking_low_contrast", 0.05, 0.0, 10.0, "",
                                       "RMS contrast up to which the whole budget is allowed", open),
                         realParameter("masking_high_contrast", 0.2, 0.0, 10.0, "",
                                       "RMS contrast from which on 'masking_budget' is allowed", open)},
          .make = [](const ParameterValues& values) { return std::make_unique<MaskingBudget>(values); },
          .check = checkMaskingBudget};
}

}  // namespace limen::techniques
