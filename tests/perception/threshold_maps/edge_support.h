// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "perception/multiscale/plane.h"

namespace limen::perception {

/// A vertical edge from 50 to 150 cd/m2 in the middle.
inline Plane edgePattern(int width, int height) {
  Plane out(width, height, 50.0);
  for (int y = 0; y < height; ++y)
    for (int x = width / 2; x < width; ++x) out.at(x, y) = 150.0;
  return out;
}

/// Width of the region that an average covers, as its edge response shows it: step over steepest slope. A box
/// of n pixels answers n. Slopes are taken over a tenth of the rise, so that a single pixel's does not
/// decide.
inline double edgeSupportPx(const Plane& averaged) {
  const int y = averaged.height / 2;
  const auto [lowest, highest] = std::minmax_element(averaged.row(y), averaged.row(y) + averaged.width);
  const double low = *lowest, step = *highest - low;
  // Distance between the 45 % and 55 % crossings, interpolated.
  const auto crossing = [&](double share) {
    const double level = low + share * step;
    for (int x = 1; x < averaged.width; ++x)
      if (averaged.at(x - 1, y) < level && averaged.at(x, y) >= level)
        return x - 1 + (level - averaged.at(x - 1, y)) / (averaged.at(x, y) - averaged.at(x - 1, y));
    return 0.0;
  };
  return 10.0 * (crossing(0.55) - crossing(0.45));
}

}  // namespace limen::perception
