// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/quality/masking_budget.h"

#include <epoxy/gl.h>

#include <optional>

#include "renderer/frame/g_buffer.h"
#include "renderer/frame/shaded.h"
#include "renderer/techniques/soft_shadows/quality/quality_bindings.h"

namespace limen::techniques {
namespace {

const char* const kMaskingShader = "renderer/techniques/soft_shadows/quality/masking_budget.comp.glsl";
const char* const kMaskingPass = "soft_shadows/budget_map";

class MaskingBudgetDriver : public BudgetDriver {
 public:
  explicit MaskingBudgetDriver(const MaskingBudget& settings) : settings_(settings) {
    // Albedo times cosine: contrasts of the direct light only, whatever the scene's brightness.
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
    rowsOf_->set("radius", settings_.radius);
    picture.bindTexture(kMaskingBudgetPictureUnit);
    receivers.bindTexture(kMaskingBudgetReceiversUnit);
    rows_->bindImage(kMaskingBudgetRowsImage, gl::Access::Write);
    rowsOf_->dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    budgetOf_->set("sizePx", frame.sizePx());
    budgetOf_->set("radius", settings_.radius);
    budgetOf_->set("lowContrast", static_cast<float>(settings_.lowContrast));
    budgetOf_->set("highContrast", static_cast<float>(settings_.highContrast));
    setRoots(*budgetOf_, settings_.range());
    rows_->bindTexture(kMaskingBudgetRowsUnit);
    map_->bindImage(kMaskingBudgetImage, gl::Access::Write);
    budgetOf_->dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    return *map_;
  }

 private:
  MaskingBudget settings_;
  frame::ShadedSetting picture_;
  std::optional<gl::Texture> rows_, map_;
  const gl::Program *rowsOf_ = nullptr, *budgetOf_ = nullptr;
};

}  // namespace

std::unique_ptr<BudgetDriver> makeBudgetDriver(const MaskingBudget& settings) {
  return std::make_unique<MaskingBudgetDriver>(settings);
}

}  // namespace limen::techniques
