// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/quality/frame_time_budget.h"

#include <epoxy/gl.h>

#include <cmath>
#include <optional>

#include "renderer/techniques/soft_shadows/quality/budget_range.h"
#include "renderer/techniques/soft_shadows/quality/frame_stopwatch.h"
#include "renderer/techniques/soft_shadows/quality/frame_time_controller.h"

namespace limen::techniques {
namespace {

constexpr const char* kUniformBase = "uniform";

FrameTimeSettings settingsOf(const ParameterValues& values) {
  const BudgetRange range = BudgetRange::of(values, "frame_time");
  FrameTimeSettings settings;
  settings.targetMs = values.real("frame_time_ms");
  settings.leastScale =
      static_cast<double>(range.least) / static_cast<double>(std::max<int64_t>(range.most, 1));
  settings.gain = values.real("frame_time_gain");
  settings.deadBand = values.real("frame_time_dead_band");
  settings.memory = static_cast<double>(values.integer("frame_time_memory"));
  settings.largestFactor = values.real("frame_time_largest_factor");
  return settings;
}

class FrameTimeBudget : public BudgetDriver {
 public:
  explicit FrameTimeBudget(const ParameterValues& values)
      : range_(BudgetRange::of(values, "frame_time")),
        dithers_(values.boolean("frame_time_dither")),
        settleFrames_(static_cast<int>(values.integer("frame_time_settle_frames"))),
        controller_(settingsOf(values)),
        base_(makeBudgetDriver(values.text("frame_time_base"), values)) {}

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
    if (base) base->bindTexture(0);
    map_->bindImage(0, gl::Access::Write);
    program_->dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    return *map_;
  }

  void begin() override {
    if (base_) base_->begin();
    stopwatch_->start(scale_);
  }

  void finish(frame::Frame& frame, const gl::Buffer* work) override {
    stopwatch_->stop();
    if (base_) base_->finish(frame, work);
  }

  int settleFrames() const override { return settleFrames_; }

  std::vector<Counter> count() const override {
    std::vector<Counter> all = base_ ? base_->count() : std::vector<Counter>{};
    all.push_back({"budget_scale", controller_.scale(), "", false});
    all.push_back({"frame_time_error_share", controller_.errorShare(), "", false});
    all.push_back({"frame_time_oscillations", static_cast<double>(controller_.oscillations()), "", false});
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

BudgetDriverInfo frameTimeBudgetInfo(const std::vector<BudgetDriverInfo>& others) {
  std::vector<std::string> bases = {kUniformBase};
  for (const BudgetDriverInfo& other : others) bases.push_back(other.name);
  const char* open = "Schwarz 2009, chapter 5 (open there)";
  return {
      .name = "frame_time",
      .parameters =
          {BudgetRange::parameter("frame_time", "at the least, however long a frame takes", open),
           realParameter("frame_time_ms", 2.0, 1e-9, 1e9, "ms",
                         "Time that the passes of the technique are to take, those that a budget changes",
                         open),
           choiceParameter("frame_time_base", kUniformBase, bases,
                           "What is scaled: 'budget' for all pixels, or another map"),
           realParameter("frame_time_gain", 0.25, 0.01, 1.0, "",
                         "Share of the change that a frame's time asks for that is followed", open),
           realParameter("frame_time_dead_band", 0.05, 0.0, 1.0, "",
                         "Error of the time, as a share of it, that is left alone", open),
           integerParameter("frame_time_memory", 32, 2, 4096, "frames",
                            "Past frames that the fixed part of the cost is fitted to", open),
           realParameter("frame_time_largest_factor", 4.0, 1.01, 1000.0, "",
                         "Largest change of the scale that one frame can ask for", open),
           booleanParameter("frame_time_dither", true,
                            "Give pixels one of the two whole counts per axis around a scaled one, by share; "
                            "otherwise all the smaller one"),
           integerParameter("frame_time_settle_frames", 32, 0, 4096, "frames",
                            "Frames that run before the first that is shown or timed, as part of the "
                            "preparation")},
      .make = [](const ParameterValues& values) { return std::make_unique<FrameTimeBudget>(values); },
      .check = [](const ParameterValues& values) { BudgetRange::check(values, "frame_time"); },
      .base = [](const ParameterValues& values) { return values.text("frame_time_base"); },
      .counters = {"budget_scale", "frame_time_error_share", "frame_time_oscillations"}};
}

}  // namespace limen::techniques
