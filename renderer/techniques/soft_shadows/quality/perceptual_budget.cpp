// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/quality/perceptual_budget.h"

#include <epoxy/gl.h>

#include <optional>

#include "perception/threshold_maps/threshold_map_gpu.h"
#include "renderer/frame/shaded.h"
#include "renderer/techniques/soft_shadows/quality/budget_range.h"

namespace limen::techniques {
namespace {

const char* const kPerceptualShader = "renderer/techniques/soft_shadows/quality/perceptual_budget.comp.glsl";
const char* const kPerceptualPass = "soft_shadows/budget_map";

class PerceptualBudget : public BudgetDriver {
 public:
  explicit PerceptualBudget(const ParameterValues& values)
      : range_(BudgetRange::of(values, "perceptual")),
        display_(perception::displayPreset(values.text("perceptual_display"))),
        error_(values.real("perceptual_error")),
        thresholds_(values.real("perceptual_thresholds")) {
    picture_.ambient = values.real("perceptual_ambient");
    picture_.diffuse = values.real("perceptual_diffuse");
    direct_ = picture_;
    direct_.ambient = 0.0;
    direct_.background = 0.0;
  }

  void prepare(frame::Frame& frame) override {
    map_.emplace(gl::Format::R32F, frame.sizePx());
    thresholdMap_.emplace(frame.context(), frame.sizePx(), display_, perception::ThresholdMapSettings{});
    frame.passes().setBytesHeld(kPerceptualPass, map_->bytes());
    frame.passes().setBytesHeld("threshold_map/levels", thresholdMap_->bytesHeld());
    program_ = &frame.context().programs().compute(kPerceptualShader);
  }

  const gl::Texture& make(frame::Frame& frame) override {
    const gl::Texture& direct = frame.get<frame::Shaded>(direct_).texture();
    const gl::Texture& thresholds =
        thresholdMap_->run(frame.get<frame::Shaded>(picture_).texture(), &frame.passes());
    const auto scope = frame.passes().open(kPerceptualPass);
    program_->set("sizePx", frame.sizePx());
    program_->set("whiteCdM2", static_cast<float>(display_.whiteLevelCdM2() - display_.blackLevelCdM2()));
    program_->set("errorOfOne", static_cast<float>(error_));
    program_->set("allowedThresholds", static_cast<float>(thresholds_));
    range_.configure(*program_);
    thresholds.bindTexture(0);
    direct.bindTexture(1);
    map_->bindImage(0, gl::Access::Write);
    program_->dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    return *map_;
  }

  std::map<std::string, const gl::Texture*> debugViews() const override {
    return {{"budget_thresholds", &thresholdMap_->map()}};
  }

 private:
  BudgetRange range_;
  perception::DisplayProfile display_;
  double error_, thresholds_;
  frame::ShadedSetting picture_, direct_;
  std::optional<gl::Texture> map_;
  std::optional<perception::ThresholdMapGpu> thresholdMap_;
  const gl::Program* program_ = nullptr;
};

}  // namespace

BudgetDriverInfo perceptualBudgetInfo() {
  const char* open = "Schwarz 2009, section 5.2.1 (open there)";
  return {
      .name = "perceptual",
      .parameters =
          {BudgetRange::parameter("perceptual", "where errors are seen least", open),
           realParameter("perceptual_error", 2.0, 0.0, 16.0, "",
                         "Error of the visibility that one micro-occluder an axis makes (c); r of them make "
                         "the r-th part of it",
                         open),
           realParameter("perceptual_thresholds", 1.0, 0.01, 1000.0, "threshold",
                         "Multiple of the visible increment that errors may reach", open),
           choiceParameter("perceptual_display", "schwarz_2009", perception::displayPresets(),
                           "Display and viewing distance that the budget is for",
                           "Schwarz 2009, section 10.4.1"),
           realParameter("perceptual_ambient", 0.2, 0.0, 1.0, "",
                         "Share of the albedo that is seen without the light, for the threshold map"),
           realParameter("perceptual_diffuse", 0.8, 0.0, 1.0, "",
                         "Share of the albedo by the cosine to the light: what the visibility multiplies")},
      .make = [](const ParameterValues& values) { return std::make_unique<PerceptualBudget>(values); },
      .check = [](const ParameterValues& values) { BudgetRange::check(values, "perceptual"); }};
}

}  // namespace limen::techniques
