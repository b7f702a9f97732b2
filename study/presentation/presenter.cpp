// SPDX-License-Identifier: BSD-3-Clause
#include "study/presentation/presenter.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/base/error.h"
#include "experiments/base/text.h"

namespace limen::study {
namespace {

const std::vector<std::string> kCorners = {"upper_left", "upper_right", "lower_left", "lower_right"};

void drawCross(ScreenDevice& screen, const PresenterSetting& setting) {
  const glm::ivec2 middle = screen.sizePx() / 2;
  const int length = setting.fixationSizePx, width = setting.fixationWidthPx;
  screen.fill(middle - glm::ivec2(length, width) / 2, {length, width}, setting.fixation);
  screen.fill(middle - glm::ivec2(width, length) / 2, {width, length}, setting.fixation);
}

void drawCue(ScreenDevice& screen, const Cue& cue, const Place& place, const PresenterSetting& setting) {
  const glm::dvec2 at = glm::dvec2(place.topLeftPx) + glm::dvec2(cue.xPx, cue.yPx);
  if (cue.kind == Cue::Kind::Circle) screen.ring(at, cue.radiusPx, setting.cueWidthPx, setting.fixation);
  if (cue.kind == Cue::Kind::Arrow) screen.arrow(at, setting.arrowLengthPx, setting.fixation);
}

void drawPatch(ScreenDevice& screen, const PhotodiodePatch& patch, const DueFrame& due) {
  if (patch.sizePx <= 0) return;
  const bool right = patch.corner == Corner::UpperRight || patch.corner == Corner::LowerRight;
  const bool lower = patch.corner == Corner::LowerLeft || patch.corner == Corner::LowerRight;
  const glm::ivec2 rest = screen.sizePx() - patch.sizePx;
  const bool white = due.frame >= 0 && (due.after || due.frame % 2 == 1);
  screen.fill({right ? rest.x : 0, lower ? rest.y : 0}, glm::ivec2(patch.sizePx), white ? 1.0 : 0.0);
}

class Performance {
 public:
  Performance(const Schedule& schedule, PictureSource& pictures, ScreenDevice& screen,
              const PresenterSetting& setting)
      : schedule_(schedule), pictures_(pictures), screen_(screen), setting_(setting) {
    times_.reserve(schedule.due.size());
    out_.frames.reserve(schedule.due.size());
  }

  Shown run() {
    for (int blank = 0; blank < schedule_.blanks() && out_.reason.empty(); ++blank) {
      draw(blank);
      times_.push_back(screen_.swap());
      if (setting_.mark) mark(static_cast<size_t>(blank));
      if (screen_.lost()) out_.reason = "window lost";
      for (const ScreenEvent& event : screen_.poll()) hear(event, blank);
    }
    evaluate();
    return std::move(out_);
  }

 private:
  void draw(int blank) {
    const DueFrame& due = schedule_.due[static_cast<size_t>(blank)];
    const Phase& phase = schedule_.phaseOf(blank);
    screen_.clear(setting_.background);
    if (phase.kind == PhaseKind::Fixation) drawCross(screen_, setting_);
    if (due.frame >= 0) {
      const int first = schedule_.sideBySide ? 0 : phase.stimulus;
      const int end = schedule_.sideBySide ? static_cast<int>(schedule_.places.size()) : phase.stimulus + 1;
      for (int i = first; i < end; ++i) {
        const auto at = static_cast<size_t>(i);
        const int frame = std::min(due.frame, schedule_.timelines[at].frames - 1);
        screen_.draw(pictures_.picture(i, frame), schedule_.places[at].topLeftPx,
                     schedule_.places[at].sizePx);
        if (phase.kind == PhaseKind::Cue)
          drawCue(screen_, schedule_.cues[at], schedule_.places[at], setting_);
      }
    }
    drawPatch(screen_, setting_.patch, due);
  }

  void mark(size_t blank) {
    const bool shows = showsStimulus(blank), showed = blank > 0 && showsStimulus(blank - 1);
    const bool same = shows && showed && schedule_.due[blank].phase == schedule_.due[blank - 1].phase;
    if (showed && !same) setting_.mark(MarkerKind::StimulusEnd, times_.back());
    if (shows && !same) setting_.mark(MarkerKind::Stimulus, times_.back());
    if (same && schedule_.due[blank].after && !schedule_.due[blank - 1].after)
      setting_.mark(MarkerKind::Change, times_.back());
  }

  void hear(const ScreenEvent& event, int blank) {
    out_.inputs.push_back({event, schedule_.phaseOf(blank).kind});
    std::string stop;
    if (setting_.stop)
      stop = setting_.stop(event);
    else if (event.kind == ScreenEvent::Kind::Close)
      stop = "window closed";
    if (stop.empty()) return;
    out_.stopped = true;
    if (out_.reason.empty()) out_.reason = stop;
  }

  bool showsStimulus(size_t blank) const {
    return schedule_.phaseOf(static_cast<int>(blank)).kind == PhaseKind::Stimulus;
  }

  void evaluate() {
    SwapSetting swaps = setting_.swaps;
    swaps.nominalHz = schedule_.refreshHz;
    out_.swaps = classifySwaps(times_, swaps);
    int missed = 0, early = 0;
    for (size_t i = 0; i < times_.size(); ++i) {
      const Swap& swap = out_.swaps.swaps[i];
      // The predecessor stayed on too long; the swap that did not wait took its predecessor's place.
      if (i > 0 && showsStimulus(i - 1)) {
        missed += swap.missed;
        early += swap.kind == SwapKind::Early;
      }
      if (!showsStimulus(i)) continue;
      const Phase& phase = schedule_.phaseOf(static_cast<int>(i));
      out_.frames.push_back({phase.stimulus, phase.showing, schedule_.due[i].frame, times_[i], swap.missed});
    }
    if (!times_.empty()) out_.endNs = times_.back();
    if (!out_.reason.empty()) return;
    if (!out_.swaps.waits)
      out_.reason = "swaps do not wait for the vertical blank";
    else if (std::abs(out_.swaps.refreshHz() / schedule_.refreshHz - 1.0) > 0.01)
      out_.reason = fmt::format("the display runs at {:.2f} Hz, not {:.2f}", out_.swaps.refreshHz(),
                                schedule_.refreshHz);
    else if (missed > setting_.missedBlanksAtMost)
      out_.reason = missed == 1 ? "1 missed frame" : fmt::format("{} missed frames", missed);
    else if (early > setting_.earlySwapsAtMost)
      out_.reason =
          early == 1 ? "1 frame shown too briefly" : fmt::format("{} frames shown too briefly", early);
    out_.valid = out_.reason.empty();
  }

  const Schedule& schedule_;
  PictureSource& pictures_;
  ScreenDevice& screen_;
  const PresenterSetting& setting_;
  std::vector<int64_t> times_;
  Shown out_;
};

}  // namespace

Corner cornerOf(const std::string& name) {
  for (size_t i = 0; i < kCorners.size(); ++i)
    if (kCorners[i] == name) return static_cast<Corner>(i);
  throw Error("no corner '" + name + "'", {}, suggest(name, kCorners));
}

Shown present(const Schedule& schedule, PictureSource& pictures, ScreenDevice& screen,
              const PresenterSetting& setting) {
  return Performance(schedule, pictures, screen, setting).run();
}

std::string earlyAnswer(const Shown& shown, const std::function<bool(const ScreenEvent&)>& isAnswer) {
  for (const EarlyInput& input : shown.inputs) {
    if (!isAnswer(input.event)) continue;
    switch (input.during) {
      case PhaseKind::Stimulus:
        return "answered during the stimulus";
      case PhaseKind::Cue:
        return "answered during the cue";
      case PhaseKind::Fixation:
        return "answered during the fixation";
      // The last frame of all is the question's.
      case PhaseKind::End:
        break;
      default:
        return "answered during the blank";
    }
  }
  return {};
}

}  // namespace limen::study
