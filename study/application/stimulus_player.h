// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "study/presentation/markers.h"
#include "study/session/front_end.h"

namespace limen::study {

struct PlayResult {
  std::vector<ShownFrame> frames;
  std::string invalid;   ///< why what was seen is not as intended ("2 missed frames"); "" if it is
  bool stopped = false;  ///< `goOn` ended it
  int64_t endNs = 0;     ///< steady clock when the last stimulus left the screen
};

/// Presents the stimuli of a trial.
class StimulusPlayer {
 public:
  virtual ~StimulusPlayer() = default;
  /// Makes everything that play() needs, while something neutral is on screen; calls `idle` now and then.
  virtual void prepare(const Trial& trial, const Session& session, const std::function<void()>& idle) = 0;
  /// Shows the prepared stimuli with the gaps between them, from background to background. Asks `goOn`
  /// between frames, a few microseconds each, and ends at once if it says no.
  virtual PlayResult play(const std::function<bool()>& goOn) = 0;
  /// Called once in each trial with a frame of its first stimulus in the window's back buffer, for a picture
  /// of it; costs that frame its time.
  void setCapture(std::function<void()> capture) { capture_ = std::move(capture); }
  /// Told of stimuli and changes as they come on screen.
  void setMarkers(Markers* markers) { markers_ = markers; }
  /// For FrontEnd::environment().
  virtual nlohmann::json environment() const { return nlohmann::json::object(); }

 protected:
  std::function<void()> capture_;
  Markers* markers_ = nullptr;
};

}  // namespace limen::study
