// SPDX-License-Identifier: BSD-3-Clause
#include "study/stimulus/timeline.h"

#include <fmt/format.h>

#include <cmath>

#include "experiments/base/error.h"

namespace limen::study {
namespace {

/// An hour at 1000 Hz; longer sequences are slips of a unit.
constexpr double kMostFrames = 3.6e6;

}  // namespace

int framesFor(double seconds, double refreshHz) {
  const double frames = seconds * refreshHz;
  if (!(frames >= 0.0 && frames <= kMostFrames))
    throw Error(fmt::format("{} s at {} Hz", seconds, refreshHz), "stimulus",
                "give times from 0 s to an hour and a refresh rate above 0");
  return static_cast<int>(std::ceil(frames - kFrameTolerance));
}

Timeline timelineOf(const Stimulus& stimulus, double refreshHz) {
  Timeline out;
  out.refreshHz = refreshHz;
  out.frames = framesFor(stimulus.durationS, refreshHz);
  out.changed = out.frames;
  out.dynamic = stimulus.presentation == Presentation::Dynamic;
  out.sceneStartS = stimulus.sceneStartS;
  out.restS = stimulus.sceneStartS + stimulus.changeAtS;
  if (out.frames < 1)
    throw Error(fmt::format("a sequence of {} s has no frame at {} Hz", stimulus.durationS, refreshHz),
                "stimulus", "raise 'duration_s'");
  const int changed = framesFor(stimulus.changeAtS, refreshHz);
  out.changeSceneTimeS = out.sceneTimeS(changed);
  const bool hasAfter = stimulus.levels || stimulus.after;
  if (!stimulus.changes || !hasAfter) {
    out.startsAfter = hasAfter && stimulus.catchShowsAfter;
    return out;
  }
  out.changed = changed;
  if (out.changed < 1 || out.changed >= out.frames)
    throw Error(fmt::format("a change at {} s leaves no frame before or after it in a sequence of {} s",
                            stimulus.changeAtS, stimulus.durationS),
                "stimulus", "put 'change_at_s' within the sequence");
  return out;
}

}  // namespace limen::study
