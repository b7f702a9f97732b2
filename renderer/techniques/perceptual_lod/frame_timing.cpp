// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/perceptual_lod/frame_timing.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>
#include <vector>

namespace limen::techniques {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kWakingSeconds = 0.5, kWarmupSeconds = 0.5, kTimingSeconds = 1.0;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void renderOne(frame::Frame& frame, const std::function<void()>& render) {
  frame.begin();
  render();
  frame.end();
}

}  // namespace

double medianFrameMs(frame::Frame& frame, const std::function<void()>& render, const TimedFrames& timed) {
  const bool software = frame.context().device().software;
  auto start = Clock::now();
  for (int i = 0; i == 0 || (i < timed.warmup && secondsSince(start) < kWarmupSeconds); ++i) {
    renderOne(frame, render);
    if (i == 0) glFinish();
  }
  frame.passes().startRecording(software ? gl::Clock::Wall : gl::Clock::Gpu, timed.frames,
                                gl::Recorded::Frames);
  start = Clock::now();
  for (int i = 0; i < timed.frames && (i < 2 || secondsSince(start) < kTimingSeconds); ++i) {
    renderOne(frame, render);
    // With a long queue, seconds of work would pass before the limit is noticed.
    if (i == 0) glFinish();
  }
  std::vector<double> times;
  for (const gl::PassTime& time : frame.passes().finishRecording())
    if (time.pass == "frame") times.push_back(1e-6 * double(time.nanoseconds));
  std::sort(times.begin(), times.end());
  const size_t middle = times.size() / 2;
  return times.size() % 2 == 1 ? times[middle] : 0.5 * (times[middle - 1] + times[middle]);
}

void wakeUp(frame::Frame& frame, const std::function<void()>& render) {
  if (frame.context().device().software) return;
  for (const auto start = Clock::now(); secondsSince(start) < kWakingSeconds;) {
    renderOne(frame, render);
    glFinish();
  }
}

}  // namespace limen::techniques
