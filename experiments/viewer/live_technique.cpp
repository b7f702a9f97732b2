// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/live_technique.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>

#include "experiments/scene_rendering.h"

namespace limen::viewer {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The median of non-empty values, which are reordered.
double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

LiveTechnique::LiveTechnique(gl::Context& context, const frame::SceneOnGpu& onGpu, glm::ivec2 sizePx,
                             const experiments::Configuration& choice)
    : info_(techniques::TechniqueRegistry::instance().get(choice.name)),
      frame_(context, onGpu, sizePx),
      clock_(context.device().software || info_.onCpu ? gl::Clock::Wall : gl::Clock::Gpu) {
  experiments::requireTraits(info_, onGpu.scene);
  technique_ = info_.make(choice.values);
  const double compiledBefore = context.programs().compileMs();
  const auto start = Clock::now();
  technique_->prepare(frame_);
  renderFrame();
  glFinish();
  prepareMs_ = 1e3 * secondsSince(start) - (context.programs().compileMs() - compiledBefore);
}

void LiveTechnique::renderFrame() {
  frame_.begin();
  technique_->render(frame_);
  frame_.end();
  ++framesRendered_;
}

void LiveTechnique::render(int frames, double seconds) {
  frame_.setTime(0.0);
  std::map<std::string, std::map<int, double>> byPass;
  const auto record = [&](int most, gl::Recorded what) {
    frame_.passes().startRecording(clock_, most, what);
    const auto start = Clock::now();
    for (int i = 0; i < most && (i == 0 || secondsSince(start) < seconds); ++i) {
      renderFrame();
      // With a long queue, seconds of work would pass before the limit is noticed.
      if (i == 0 && most > 1) glFinish();
    }
    for (const gl::PassTime& time : frame_.passes().finishRecording())
      byPass[time.pass][time.frame] += 1e-6 * static_cast<double>(time.nanoseconds);
  };
  if (clock_ == gl::Clock::Gpu) {
    record(frames, gl::Recorded::Frames);
    record((frames + 3) / 4, gl::Recorded::Passes);
  } else {
    record(frames, gl::Recorded::Both);
  }
  passMs_.clear();
  for (const auto& [pass, ofFrames] : byPass) {
    std::vector<double> times;
    for (const auto& [number, ms] : ofFrames) times.push_back(ms);
    passMs_[pass] = median(times);
  }
  const auto whole = passMs_.find("frame");
  frameMs_ = whole == passMs_.end() ? -1.0 : whole->second;
}

std::vector<PassFigure> LiveTechnique::passes() {
  std::vector<PassFigure> out;
  for (const gl::PassList::Pass& pass : frame_.passes().passes()) {
    if (!pass.ran) continue;  // counting has passes of its own
    const auto ms = passMs_.find(pass.name);
    out.push_back({pass.name, ms == passMs_.end() ? -1.0 : ms->second, pass.bytesHeld});
  }
  return out;
}

}  // namespace limen::viewer
