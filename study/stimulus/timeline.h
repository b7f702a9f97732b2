// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "study/stimulus/stimulus.h"

namespace limen::study {

/// Times are written in decimals and frames are not: what comes within a thousandth of a frame of a vertical
/// blank is meant to fall on it.
inline constexpr double kFrameTolerance = 1e-3;

/// Smallest number of frames that lasts at least `seconds`; at `refreshHz` frames a second frame k begins at
/// k / refreshHz. 0 for a time of 0.
int framesFor(double seconds, double refreshHz);

/// A sequence in frames of one display. Frame k is on the screen from k / refreshHz on; there are as many as
/// it takes to fill Stimulus::durationS, and the first that shows what comes after the change is the first
/// whose time is not before Stimulus::changeAtS.
struct Timeline {
  double refreshHz = 60.0;
  int frames = 0;
  int changed = 0;           ///< first frame after the change; equals `frames` in a sequence without change
  bool startsAfter = false;  ///< without change: which of the two states is shown throughout
  bool dynamic = true;
  double sceneStartS = 0.0, restS = 0.0;
  /// Scene time of the first frame at or after the change, whether or not the sequence has one.
  double changeSceneTimeS = 0.0;

  bool showsAfter(int frame) const { return startsAfter || frame >= changed; }
  /// Time on the scene's camera path.
  double sceneTimeS(int frame) const { return dynamic ? sceneStartS + frame / refreshHz : restS; }
};

/// Throws Error on a sequence without a frame, and on a change that has no frame before or none after it.
Timeline timelineOf(const Stimulus& stimulus, double refreshHz);

}  // namespace limen::study
