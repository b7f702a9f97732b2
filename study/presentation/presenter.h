// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "study/presentation/schedule.h"
#include "study/presentation/screen_device.h"
#include "study/presentation/swap_timer.h"
#include "study/session/front_end.h"

namespace limen::study {

/// Where the frames of a trial's stimuli come from.
class PictureSource {
 public:
  virtual ~PictureSource() = default;
  /// Called during presentation: allocates, compiles and reads back nothing.
  virtual Picture picture(int stimulus, int frame) = 0;
};

enum class Corner { UpperLeft, UpperRight, LowerLeft, LowerRight };
/// Throws Error on an unknown name: "upper_left" ...
Corner cornerOf(const std::string& name);

/// A square for a light sensor: white while a stimulus shows its state after the change, and otherwise on odd
/// frames; black the rest of the time.
struct PhotodiodePatch {
  int sizePx = 0;  ///< 0: none
  Corner corner = Corner::LowerLeft;
};

struct PresenterSetting {
  double background = 0.05;  ///< linear light
  double fixation = 0.5;     ///< linear light of cross and cues
  int fixationSizePx = 24, fixationWidthPx = 3;
  double cueWidthPx = 3.0, arrowLengthPx = 60.0;
  PhotodiodePatch patch;
  /// A trial is invalid if frames of its stimuli stayed on screen for more extra blanks than this in total
  /// ...
  int missedBlanksAtMost = 0;
  /// ... or more of them than this may never have been seen.
  int earlySwapsAtMost = 0;
  SwapSetting swaps;  ///< its nominal rate is the schedule's
  /// Called right after the swap that began or ended a stimulus or showed its change, with the time of it.
  std::function<void(MarkerKind, int64_t swapNs)> mark;
  /// Stops the trial at an event, which makes it invalid with the returned text; empty continues. Without it,
  /// closing the window stops it.
  std::function<std::string(const ScreenEvent&)> stop;
};

/// An event during the trial, before its question.
struct EarlyInput {
  ScreenEvent event;
  PhaseKind during = PhaseKind::End;
};

struct Shown {
  bool valid = false;
  std::string reason;              ///< why not: "2 missed frames", "window lost" ...
  bool stopped = false;            ///< by an event
  std::vector<ShownFrame> frames;  ///< of stimuli, as the log takes them; side by side with stimulus 0
  SwapReport swaps;                ///< of all blanks of the schedule
  int64_t endNs = 0;               ///< when the last picture left the screen
  std::vector<EarlyInput> inputs;
};

/// Shows a schedule, one frame per vertical blank, to its end or until the window is lost or an event stops
/// it. Missed blanks count against a trial if a stimulus stayed on too long because of them; in pauses they
/// do not.
Shown present(const Schedule& schedule, PictureSource& pictures, ScreenDevice& screen,
              const PresenterSetting& setting);

/// Why an answer among the early inputs is refused: "answered during the blank" (in a gap), "answered during
/// the stimulus" ...; empty if `isAnswer` accepts none of them.
std::string earlyAnswer(const Shown& shown, const std::function<bool(const ScreenEvent&)>& isAnswer);

}  // namespace limen::study
