// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "perception/vision/display.h"

namespace limen::study {

/// Linear light at which a display's 8-bit code goes up by one: entry c - 1 is the least light that is shown
/// as code c, halfway between two codes on the transfer curve. Ascending. With them a picture is coded
/// exactly as the curve says in double precision, whatever powers a GPU computes.
using CodeThresholds = std::array<float, 255>;
CodeThresholds codeThresholds(const perception::DisplayProfile& display);

/// Code that shows linear light nearest on the transfer curve; light outside 0..1 is clamped, NaN is 0.
int displayCode(const perception::DisplayProfile& display, double linear);

}  // namespace limen::study
