// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "renderer/frame/frame.h"
#include "renderer/techniques/scene_needs/candidate.h"

namespace limen::techniques {

/// Times candidates. An interface, so that choices can be tested with times that are known.
class CandidateClock {
 public:
  virtual ~CandidateClock() = default;
  /// Times of whole frames [ms], at least one, in the size at which the scene is to be rendered.
  virtual std::vector<double> framesMs(const Candidate& candidate) = 0;
  /// What the times are.
  virtual std::string label() const = 0;
};

/// How often a candidate is rendered to be timed.
struct CandidateTiming {
  int warmup = 4, frames = 16;
  static const SettingsTable<CandidateTiming>& table();
};

/// Times frames of the given frame's view and size that are rendered for this alone: by timestamps of the
/// GPU, or of a software renderer, whose timestamps are wrong, by the wall clock around glFinish. Slow
/// candidates get fewer frames: no more are rendered after half a second. While a candidate's shaders are
/// compiled a GPU idles and lowers its clock rate (an H200 showed three times the time after it): it is
/// woken first.
class FrameClock : public CandidateClock {
 public:
  /// `added`: counters [ms] that are added to every frame of the candidates that have them, as what a scene
  /// that moves would cost anew in each.
  FrameClock(frame::Frame& frame, const CandidateTiming& timing, std::vector<std::string> added = {})
      : frame_(frame), timing_(timing), added_(std::move(added)) {}
  std::vector<double> framesMs(const Candidate& candidate) override;
  std::string label() const override;

 private:
  bool software() const { return frame_.context().device().software; }

  frame::Frame& frame_;
  CandidateTiming timing_;
  std::vector<std::string> added_;
  std::chrono::steady_clock::time_point lastBusy_{};  ///< when the GPU was last seen at work
};

}  // namespace limen::techniques
