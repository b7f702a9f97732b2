// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/base/image.h"

namespace limen::perception {

/// LDR-FLIP in double precision, straight from the paper: two-dimensional kernels, one plain convolution
/// each. Takes linear images of 3 channels with values in [0, 1]; gives the map.
struct FlipReference {
  Image map;
  double mean = 0.0;
};
FlipReference computeFlipReference(const Image& test, const Image& reference, double pixelsPerDegree);

}  // namespace limen::perception
