// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "renderer/frame/frame.h"

namespace limen::techniques {

/// How often frames are rendered to be timed.
struct TimedFrames {
  int warmup = 4, frames = 32;
};

/// Median time [ms] of frames that `render` makes in `frame`: by timestamps of the GPU, or of a software
/// renderer, whose timestamps are wrong, by the wall clock around glFinish. Waits for the GPU. Slow frames
/// are fewer: none is begun after half a second of warm-up, and none after a second of timing but the first
/// two.
double medianFrameMs(frame::Frame& frame, const std::function<void()>& render, const TimedFrames& timed);
/// Keeps the GPU busy with `render` until its clock is up; does nothing on a software renderer.
void wakeUp(frame::Frame& frame, const std::function<void()>& render);

}  // namespace limen::techniques
