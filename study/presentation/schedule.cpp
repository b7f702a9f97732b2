// SPDX-License-Identifier: BSD-3-Clause
#include "study/presentation/schedule.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/base/error.h"

namespace limen::study {
namespace {

class Builder {
 public:
  explicit Builder(Schedule& schedule) : schedule_(schedule) {}

  /// `frame`: of its first blank, those that follow go on from it if the phase `moves`; -1: no stimulus.
  void add(PhaseKind kind, int blanks, int stimulus = 0, int showing = 0, int frame = -1,
           bool moves = false) {
    if (blanks <= 0) return;
    const int phase = static_cast<int>(schedule_.phases.size());
    schedule_.phases.push_back({kind, schedule_.blanks(), blanks, stimulus, showing});
    for (int i = 0; i < blanks; ++i) {
      DueFrame due{phase, frame < 0 ? -1 : frame + (moves ? i : 0), false};
      if (due.frame >= 0) due.after = showsAfter(stimulus, due.frame);
      schedule_.due.push_back(due);
    }
  }

 private:
  bool showsAfter(int stimulus, int frame) const {
    const auto after = [&](const Timeline& line) {
      return line.showsAfter(std::min(frame, line.frames - 1));
    };
    if (!schedule_.sideBySide) return after(schedule_.timelines[static_cast<size_t>(stimulus)]);
    return std::any_of(schedule_.timelines.begin(), schedule_.timelines.end(), after);
  }

  Schedule& schedule_;
};

bool areAlike(const Stimulus& a, const Stimulus& b) {
  const bool cued = a.cue.kind != Cue::Kind::None && b.cue.kind != Cue::Kind::None;
  return a.showings == b.showings && (a.showings == 1 || a.gapS == b.gapS) &&
         (!cued || a.cue.durationS == b.cue.durationS);
}

void checkAlike(const std::vector<Stimulus>& stimuli) {
  for (const Stimulus& one : stimuli)
    for (const Stimulus& other : stimuli)
      if (!areAlike(one, other))
        throw Error("stimuli side by side differ in their showings, gaps or the time of their cues",
                    "stimulus", "give them the same 'showings', 'gap_s' and 'duration_s' of the cue");
}

bool isSideBySide(const TaskSetting& task) {
  return task.type == Task::Alternative || (task.type == Task::Pairwise && task.sideBySide);
}

double cueS(const Stimulus& stimulus) {
  return stimulus.cue.kind == Cue::Kind::None ? 0.0 : stimulus.cue.durationS;
}

}  // namespace

std::string toText(PhaseKind kind) {
  switch (kind) {
    case PhaseKind::BetweenTrials:
      return "between trials";
    case PhaseKind::Fixation:
      return "fixation";
    case PhaseKind::AfterFixation:
      return "after fixation";
    case PhaseKind::Cue:
      return "cue";
    case PhaseKind::Stimulus:
      return "stimulus";
    case PhaseKind::ShowingGap:
      return "gap between showings";
    case PhaseKind::IntervalGap:
      return "gap between intervals";
    case PhaseKind::End:
      return "end";
  }
  return "";
}

int blanksFor(double seconds, double refreshHz) {
  if (!(seconds > 0.0)) return 0;
  // Checks the range too.
  const int atLeast = framesFor(seconds, refreshHz);
  return std::max(1, std::min(atLeast, static_cast<int>(std::lround(seconds * refreshHz))));
}

std::vector<Place> placesOf(int count, glm::ivec2 windowPx, glm::ivec2 screenPx, int separationPx) {
  const auto extent = [&](int n, int size) { return n * size + (n - 1) * separationPx; };
  for (int columns = count; columns >= 1; --columns) {
    const int rows = (count + columns - 1) / columns;
    if (extent(columns, windowPx.x) > screenPx.x || extent(rows, windowPx.y) > screenPx.y) continue;
    std::vector<Place> out;
    const int top = (screenPx.y - extent(rows, windowPx.y)) / 2;
    for (int i = 0; i < count; ++i) {
      const int row = i / columns, inRow = std::min(columns, count - row * columns);
      const int left = (screenPx.x - extent(inRow, windowPx.x)) / 2;
      out.push_back(
          {{left + (i % columns) * (windowPx.x + separationPx), top + row * (windowPx.y + separationPx)},
           windowPx});
    }
    return out;
  }
  throw Error(fmt::format("{} of {} x {} px do not fit on a screen of {} x {} px",
                          count == 1 ? "a window" : fmt::format("{} windows", count), windowPx.x, windowPx.y,
                          screenPx.x, screenPx.y),
              "window", "make the protocol's window smaller, or take a larger screen");
}

Schedule makeSchedule(const std::vector<Stimulus>& stimuli, const ScheduleSetting& setting) {
  if (stimuli.empty()) throw Error("a trial without stimuli", "trial");
  Schedule out;
  out.refreshHz = setting.refreshHz;
  out.screenPx = setting.screenPx;
  out.sideBySide = isSideBySide(setting.task) && stimuli.size() > 1;
  for (const Stimulus& stimulus : stimuli) {
    out.timelines.push_back(timelineOf(stimulus, setting.refreshHz));
    out.cues.push_back(stimulus.cue);
    if (stimulus.showings < 1)
      throw Error(fmt::format("'showings' is {}", stimulus.showings), "stimulus", "show it at least once");
  }
  if (out.sideBySide) {
    checkAlike(stimuli);
    out.places =
        placesOf(static_cast<int>(stimuli.size()), setting.windowPx, setting.screenPx, setting.separationPx);
  } else {
    out.places.assign(stimuli.size(), placesOf(1, setting.windowPx, setting.screenPx, 0)[0]);
  }

  Builder builder(out);
  const auto pause = [&](PhaseKind kind, double seconds, int stimulus = 0, int showing = 0) {
    builder.add(kind, blanksFor(seconds, setting.refreshHz), stimulus, showing);
  };
  pause(PhaseKind::BetweenTrials, setting.timing.betweenTrialsS);
  pause(PhaseKind::Fixation, setting.timing.fixationS);
  pause(PhaseKind::AfterFixation, setting.timing.afterFixationS);
  const size_t turns = out.sideBySide ? 1 : stimuli.size();
  for (size_t i = 0; i < turns; ++i) {
    const int number = static_cast<int>(i);
    if (i > 0) pause(PhaseKind::IntervalGap, setting.timing.intervalGapS, number);
    // Side by side one of them may have no cue, or be shorter.
    double cue = cueS(stimuli[i]);
    int frames = out.timelines[i].frames;
    for (size_t other = 0; out.sideBySide && other < stimuli.size(); ++other) {
      cue = std::max(cue, cueS(stimuli[other]));
      frames = std::max(frames, out.timelines[other].frames);
    }
    builder.add(PhaseKind::Cue, blanksFor(cue, setting.refreshHz), number, 0, 0);
    for (int showing = 0; showing < stimuli[i].showings; ++showing) {
      if (showing > 0) pause(PhaseKind::ShowingGap, stimuli[i].gapS, number, showing);
      builder.add(PhaseKind::Stimulus, frames, number, showing, 0, true);
    }
  }
  builder.add(PhaseKind::End, 1);
  return out;
}

}  // namespace limen::study
