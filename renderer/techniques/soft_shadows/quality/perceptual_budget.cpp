// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/quality/perceptual_budget.h"

#include <epoxy/gl.h>

#include <optional>

#include "perception/thresholds/thresholds_gpu.h"
#include "renderer/frame/shaded.h"
#include "renderer/techniques/soft_shadows/quality/quality_bindings.h"

namespace limen::techniques {
namespace {

const char* const kPerceptualShader = "renderer/techniques/soft_shadows/quality/perceptual_budget.comp.glsl";
const char* const kPerceptualPass = "soft_shadows/budget_map";

perception::ThresholdGpuSettings thresholdSettings(BudgetThresholds wanted) {
  using perception::PredictorModel;
  if (wanted == BudgetThresholds::Bands) return perception::BandThresholdSettings{};
  const bool thesis = wanted == BudgetThresholds::Schwarz2009;
  return perception::SingleOnGpu{perception::ThresholdMapSettings::preset(thesis ? PredictorModel::Schwarz2009
                                                                                 : PredictorModel::Limen2026),
                                 {}};
}

class PerceptualBudgetDriver : public BudgetDriver {
 public:
  explicit PerceptualBudgetDriver(const PerceptualBudget& settings)
      : settings_(settings), display_(perception::displayPreset(settings.display)) {
    picture_.ambient = settings.ambient;
    picture_.diffuse = settings.diffuse;
    direct_ = picture_;
    direct_.ambient = 0.0;
    direct_.background = 0.0;
  }

  void prepare(frame::Frame& frame) override {
    map_.emplace(gl::Format::R32F, frame.sizePx());
    frame.passes().setBytesHeld(kPerceptualPass, map_->bytes());
    maker_ = perception::makeThresholds(frame.context(), frame.sizePx(), display_,
                                        thresholdSettings(settings_.thresholdMap));
    frame.passes().setBytesHeld(perception::kThresholdLevelsPass, maker_->bytesHeld());
    program_ = &frame.context().programs().compute(kPerceptualShader);
  }

  const gl::Texture& make(frame::Frame& frame) override {
    const gl::Texture& direct = frame.get<frame::Shaded>(direct_).texture();
    const gl::Texture& picture = frame.get<frame::Shaded>(picture_).texture();
    const gl::Texture& thresholds = maker_->run(picture, &frame.passes());
    const auto scope = frame.passes().open(kPerceptualPass);
    program_->set("sizePx", frame.sizePx());
    program_->set("whiteCdM2", static_cast<float>(display_.whiteLevelCdM2() - display_.blackLevelCdM2()));
    program_->set("errorOfOne", static_cast<float>(settings_.error));
    program_->set("allowedThresholds", static_cast<float>(settings_.thresholds));
    setRoots(*program_, settings_.range());
    thresholds.bindTexture(kPerceptualBudgetThresholdsUnit);
    direct.bindTexture(kPerceptualBudgetDirectLightUnit);
    map_->bindImage(kPerceptualBudgetImage, gl::Access::Write);
    program_->dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    return *map_;
  }

  std::map<std::string, const gl::Texture*> debugViews() const override {
    return {{"budget_thresholds", &maker_->map()}};
  }

 private:
  PerceptualBudget settings_;
  perception::DisplayProfile display_;
  frame::ShadedSetting picture_, direct_;
  std::optional<gl::Texture> map_;
  std::unique_ptr<perception::ThresholdMaker> maker_;
  const gl::Program* program_ = nullptr;
};

}  // namespace

std::unique_ptr<BudgetDriver> makeBudgetDriver(const PerceptualBudget& settings) {
  return std::make_unique<PerceptualBudgetDriver>(settings);
}

}  // namespace limen::techniques
