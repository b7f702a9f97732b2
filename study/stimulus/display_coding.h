// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "perception/vision/display.h"

namespace limen::study {

/// Linear light at which a display's 8-bit code goes up by one: entry c - 1 is the smallest light shown as
/// code c, halfway between two codes on the transfer curve. Ascending. With them a picture is coded exactly
/// as by the curve in double precision, however accurate a GPU's pow() is.
using CodeThresholds = std::array<float, 255>;
CodeThresholds codeThresholds(const perception::DisplayProfile& display);

/// Code nearest to linear light on the transfer curve; light outside 0..1 is clamped, NaN is 0.
int displayCode(const perception::DisplayProfile& display, double linear);

}  // namespace limen::study
