// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "perception/popping/predictor.h"

namespace limen::perception {

/// What the predictor is compared with in Schwarz 2009, section 10.4: the largest CIE94 colour difference
/// (graphic arts) between the frames, wherever it is. The actual frame is the reference of the formula.
struct LargestColourDifference {
  double value = 0.0;  ///< dE94
  int x = 0, y = 0;    ///< first pixel that has it
};

/// Colours are those of the light between the display's black and white level, clamped to [0, 1]; the black
/// level itself, weights and displacement are not used. Throws Error like predictPopping().
LargestColourDifference largestColourDifference(const PoppingInput& input, const DisplayProfile& display);

}  // namespace limen::perception
