// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "study/protocol/protocol.h"
#include "study/stimulus/stimulus.h"
#include "study/stimulus/timeline.h"

namespace limen::study {

enum class PhaseKind {
  BetweenTrials,  ///< background
  Fixation,       ///< cross in the middle of the screen
  AfterFixation,  ///< background
  Cue,            ///< the stimulus's first frame at rest, with its cue
  Stimulus,
  ShowingGap,   ///< background between showings of one stimulus
  IntervalGap,  ///< background between intervals
  End           ///< one frame of background, which removes the last picture
};
std::string toText(PhaseKind kind);

/// A run of vertical blanks with the same content on screen.
struct Phase {
  PhaseKind kind = PhaseKind::End;
  int first = 0, blanks = 0;
  int stimulus = 0;  ///< Cue, Stimulus and ShowingGap of an interval; 0 side by side, where all are shown
  int showing = 0;
};

/// What is due at one vertical blank.
struct DueFrame {
  int phase = 0;
  int frame = -1;      ///< of the stimulus (side by side: of each, ended ones keep their last); -1: none
  bool after = false;  ///< a stimulus shows its state after the change
};

/// Position of a stimulus on screen, px from its upper left corner.
struct Place {
  glm::ivec2 topLeftPx{0}, sizePx{0};
  bool operator==(const Place&) const = default;
};

/// A trial in vertical blanks: data, the same on every machine with this screen.
struct Schedule {
  double refreshHz = 60.0;
  glm::ivec2 screenPx{0};
  bool sideBySide = false;
  std::vector<Timeline> timelines;  ///< of each stimulus
  std::vector<Place> places;        ///< of each stimulus
  std::vector<Cue> cues;            ///< of each stimulus
  std::vector<Phase> phases;        ///< one after the other, none empty
  std::vector<DueFrame> due;        ///< one per vertical blank

  int blanks() const { return static_cast<int>(due.size()); }
  const Phase& phaseOf(int blank) const {
    return phases[static_cast<size_t>(due[static_cast<size_t>(blank)].phase)];
  }
};

/// A pause's length rounded to whole vertical blanks; at least one for any length above 0.
int blanksFor(double seconds, double refreshHz);

/// Positions of `count` windows: one in the middle of the screen; several in a centred grid, filled row by
/// row from the upper left, with as many columns as fit and a short last row centred. They are `separationPx`
/// apart. Throws Error if they do not fit.
std::vector<Place> placesOf(int count, glm::ivec2 windowPx, glm::ivec2 screenPx, int separationPx);

struct ScheduleSetting {
  TaskSetting task;
  Timing timing;
  glm::ivec2 windowPx{1024, 768};  ///< of one stimulus
  glm::ivec2 screenPx{1920, 1080};
  double refreshHz = 60.0;
  int separationPx = 32;  ///< between stimuli side by side
};

/// Between trials, fixation, pause, then stimuli: one after the other with a gap between intervals, or side
/// by side. Each is shown as often as it specifies, with its own gaps and its cue before the first
/// presentation. Throws Error: no stimuli, windows that do not fit, side-by-side stimuli with different
/// numbers of presentations, gaps or cue times, and like timelineOf().
Schedule makeSchedule(const std::vector<Stimulus>& stimuli, const ScheduleSetting& setting);

}  // namespace limen::study
