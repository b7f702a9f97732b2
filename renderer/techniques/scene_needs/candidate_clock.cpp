// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/scene_needs/candidate_clock.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>

namespace limen::techniques {
namespace {

using std::chrono::steady_clock;

constexpr double kMostSeconds = 0.5;
/// An idle GPU takes some time to reach its clock rate, and loses it after some.
constexpr double kWakingSeconds = 0.2, kDozingSeconds = 0.02;

double secondsSince(steady_clock::time_point start) {
  return std::chrono::duration<double>(steady_clock::now() - start).count();
}

void renderFrame(frame::Frame& frame, Technique& technique) {
  frame.begin();
  technique.render(frame);
  frame.end();
}

}  // namespace

const SettingsTable<CandidateTiming>& CandidateTiming::table() {
  using S = CandidateTiming;
  static const SettingsTable<S> kTable = {
      {&S::warmup, "warmup", {1, 256}, "frames", "Frames of a candidate that are rendered and discarded"},
      {&S::frames,
       "frames",
       {1, 1024},
       "frames",
       "Frames of a candidate that are timed, in each of two rounds"}};
  return kTable;
}

std::string FrameClock::label() const {
  std::string text = software() ? "wall time of whole frames around glFinish, on a software renderer"
                                : "GPU time of whole frames";
  for (const std::string& counter : added_) text += ", plus " + counter + " where a technique has it";
  return text;
}

std::vector<double> FrameClock::framesMs(const Candidate& candidate) {
  const std::unique_ptr<Technique> technique = makeTechnique(candidate);
  frame::Frame frame(frame_.context(), frame_.scene(), frame_.gpuScene(), frame_.sizePx(), frame_.timeS(),
                     frame_.raster());
  frame.setShownMirrors(frame_.shownMirrors());
  technique->prepare(frame);
  const auto waking = steady_clock::now();
  const bool dozes = !software() && secondsSince(lastBusy_) > kDozingSeconds;
  for (int i = 0; i == 0 || (i < timing_.warmup && secondsSince(waking) < kMostSeconds) ||
                  (dozes && secondsSince(waking) < kWakingSeconds);
       ++i) {
    renderFrame(frame, *technique);
    glFinish();
  }
  frame.passes().startRecording(software() ? gl::Clock::Wall : gl::Clock::Gpu, timing_.frames,
                                gl::Recorded::Frames);
  const auto start = steady_clock::now();
  for (int i = 0; i < timing_.frames && (i == 0 || secondsSince(start) < kMostSeconds); ++i) {
    renderFrame(frame, *technique);
    // With a long queue, seconds of work would pass before the limit is noticed.
    if (i == 0) glFinish();
  }
  const std::vector<gl::PassTime> times = frame.passes().finishRecording();
  lastBusy_ = steady_clock::now();
  double addedMs = 0.0;
  if (!added_.empty())
    for (const Counter& counter : technique->count(frame))
      if (std::find(added_.begin(), added_.end(), counter.name) != added_.end()) addedMs += counter.value;
  std::vector<double> out;
  for (const gl::PassTime& time : times)
    if (time.pass == "frame") out.push_back(1e-6 * double(time.nanoseconds) + addedMs);
  return out;
}

}  // namespace limen::techniques
