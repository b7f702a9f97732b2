// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "experiments/executor.h"
#include "experiments/gpu_clock.h"
#include "renderer/frame/frame.h"
#include "renderer/techniques/technique.h"

namespace limen::experiments {

/// Times one technique over the rounds of a batch.
class FrameTiming {
 public:
  FrameTiming(Timing timing, gl::Clock clock) : timing_(timing), clock_(clock) {}

  /// Frames that are rendered but not timed. A slow technique gets fewer: at least one, then as many as fit
  /// in two seconds.
  void warmUp(frame::Frame& frame, techniques::Technique& technique) const;
  /// One round of timed frames; on a GPU followed by a quarter as many whose passes are timed (see
  /// gl::Recorded). `maxSeconds` cuts a round of a slow technique short, but not below one frame.
  void measureRound(frame::Frame& frame, techniques::Technique& technique, int round, double maxSeconds);

  const std::vector<store::FrameTime>& times() const { return times_; }
  /// gpu_ms and its p95, technique_ms, wall_ms, cpu_ms, timed_frames.
  std::vector<store::Measurement> summarise() const;

 private:
  Timing timing_;
  gl::Clock clock_;
  /// Renders up to `planned` frames and stores what is recorded of them. Returns how many.
  int record(frame::Frame& frame, techniques::Technique& technique, int round, int planned, double maxSeconds,
             gl::Recorded what);

  int frames_ = 0;       // rendered
  int wholeFrames_ = 0;  // of them, timed as a whole
  std::vector<store::FrameTime> times_;
};

}  // namespace limen::experiments
