// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>

#include "experiments/base/enum_names.h"
#include "experiments/base/image.h"
#include "perception/metrics/color_video_vdp/display.h"
#include "perception/metrics/color_video_vdp/temporal.h"

namespace limen::perception::cvvdp {

/// What the values of an image are.
enum class Values {
  Coded,    ///< what the display is sent: in [0, 1], or cd/m2 if its curve is linear
  Relative  ///< light, 1 is the display's white
};

struct Options {
  Display display;
  Values values = Values::Coded;
  /// If not 0, values are multiples of 1 / codeSteps (255 for 8 bits), which single precision only nearly holds;
  /// the CPU's version then uses the exact ones.
  double codeSteps = 0.0;
  double framesPerSecond = 0.0;  ///< of videos
  TemporalPadding padding = TemporalPadding::Replicate;
  /// Borders of the pyramid as in the authors' program; false: repaired.
  bool referenceBorders = true;
  bool map = false;  ///< make the maps
};

/// A frame by its index. Called for test and reference of the same index in turn; indices rise, except that
/// symmetric padding starts with the frames that stand for earlier ones. Images have 1, 3 or 4 channels; grey
/// counts as colour, alpha is ignored.
using FrameSource = std::function<Image(int)>;

/// A pair of videos of equal size, or of images (one frame).
struct Pair {
  int width = 0, height = 0, frames = 1;
  FrameSource test, reference;
};

/// Throws Error on a pair or options that cannot be evaluated: a side below 4 pixels, no frames, a video without
/// a frame rate, relative light on a display whose primaries are not sRGB's.
void check(const Pair& pair, const Options& options);

}  // namespace limen::perception::cvvdp
