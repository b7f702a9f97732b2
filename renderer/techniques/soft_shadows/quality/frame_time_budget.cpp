// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/quality/frame_time_budget.h"

#include <epoxy/gl.h>

#include <cmath>
#include <optional>

#include "renderer/techniques/soft_shadows/quality/frame_stopwatch.h"
#include "renderer/techniques/soft_shadows/quality/frame_time_controller.h"
#include "renderer/techniques/soft_shadows/quality/masking_budget.h"
#include "renderer/techniques/soft_shadows/quality/painted_budget.h"
#include "renderer/techniques/soft_shadows/quality/perceptual_budget.h"
#include "renderer/techniques/soft_shadows/quality/quality_bindings.h"
#include "renderer/techniques/soft_shadows/quality/radial_budget.h"

namespace limen::techniques {
namespace {

/// Null: the same for all pixels.
std::unique_ptr<BudgetDriver> makeBase(const FrameTimeBudget::Base& settings) {
  return std::visit(
      [](const auto& chosen) -> std::unique_ptr<BudgetDriver> {
        if constexpr (std::is_same_v<decltype(chosen), const ScaledBudget&>)
          return nullptr;
        else
          return makeBudgetDriver(chosen);
      },
      settings);
}

FrameTimeSettings controllerSettings(const FrameTimeBudget& settings) {
  const BudgetRange range = settings.range();
  return {.targetMs = settings.targetMs,
          .leastScale = static_cast<double>(range.least) / static_cast<double>(range.most),
          .gain = settings.gain,
          .deadBand = settings.deadBand,
          .memory = static_cast<double>(settings.memory),
          .largestFactor = settings.largestFactor};
}

class FrameTimeBudgetDriver : public BudgetDriver {
 public:
  explicit FrameTimeBudgetDriver(const FrameTimeBudget& settings)
      : range_(settings.range()),
        dithers_(settings.dither),
        settleFrames_(settings.settleFrames),
        controller_(controllerSettings(settings)),
        base_(makeBase(settings.base)) {}

  void prepare(frame::Frame& frame) override {
    if (base_) base_->prepare(frame);
    stopwatch_.emplace(frame.context().device().software);
    map_.emplace(gl::Format::R32F, frame.sizePx());
    frame.passes().setBytesHeld("soft_shadows/scaled_budgets", map_->bytes());
    gl::ShaderDefines defines;
    if (base_) defines["BASE_MAP"] = "1";
    program_ = &frame.context().programs().compute(
        "renderer/techniques/soft_shadows/quality/frame_time_budget.comp.glsl", defines);
  }

  const gl::Texture& make(frame::Frame& frame) override {
    const gl::Texture* base = base_ ? &base_->make(frame) : nullptr;
    for (const FrameStopwatch::Sample& sample : stopwatch_->collect())
      controller_.observe(sample.tag, sample.ms);
    scale_ = controller_.scale();
    const auto scope = frame.passes().open("soft_shadows/scaled_budgets");
    program_->set("sizePx", frame.sizePx());
    program_->set("baseRoot", range_.mostRoot());
    program_->set("leastRoot", range_.leastRoot());
    program_->set("rootScale", static_cast<float>(std::sqrt(scale_)));
    program_->set("dithers", dithers_ ? 1 : 0);
    if (base) base->bindTexture(kFrameTimeBudgetBaseMapUnit);
    map_->bindImage(kFrameTimeBudgetImage, gl::Access::Write);
    program_->dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    return *map_;
  }

  void begin() override {
    if (base_) base_->begin();
    stopwatch_->start(scale_);
  }

  void finish() override {
    stopwatch_->stop();
    if (base_) base_->finish();
  }

  int settleFrames() const override { return settleFrames_; }

  std::vector<Counter> count() const override {
    std::vector<Counter> all = base_ ? base_->count() : std::vector<Counter>{};
    all.push_back({"budget_scale", controller_.scale()});
    all.push_back({"frame_time_error_share", controller_.errorShare()});
    all.push_back({"frame_time_oscillations", static_cast<double>(controller_.oscillations())});
    return all;
  }

  std::map<std::string, const gl::Texture*> debugViews() const override {
    return base_ ? base_->debugViews() : std::map<std::string, const gl::Texture*>{};
  }

 private:
  BudgetRange range_;
  bool dithers_;
  int settleFrames_;
  FrameTimeController controller_;
  double scale_ = 1.0;                  // of this frame
  std::unique_ptr<BudgetDriver> base_;  // null: the same budget for all pixels
  std::optional<FrameStopwatch> stopwatch_;
  std::optional<gl::Texture> map_;
  const gl::Program* program_ = nullptr;
};

}  // namespace

std::unique_ptr<BudgetDriver> makeBudgetDriver(const FrameTimeBudget& settings) {
  return std::make_unique<FrameTimeBudgetDriver>(settings);
}

std::vector<Quantity> frameTimeQuantities() {
  return {
      {"budget_scale", "Scale of the budget", "", Direction::Neither},
      {"frame_time_error_share", "Error of the frame time", "", Direction::Neither},
      {"frame_time_oscillations", "Sign changes of the frame time's error", "", Direction::LowerIsBetter}};
}

}  // namespace limen::techniques
