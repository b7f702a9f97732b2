// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <glm/glm.hpp>

namespace limen::techniques {

/// Share of a rectangle around the origin, of the given extents, whose points q have `gradient` . q <
/// `depth`, summed over thin rows.
inline double shareBeforePlane(glm::dvec2 gradient, glm::dvec2 extents, double depth) {
  constexpr int kRows = 1024;
  double share = 0.0;
  for (int row = 0; row < kRows; ++row) {
    const double rest = depth - gradient.y * ((row + 0.5) / kRows - 0.5) * extents.y;
    if (gradient.x == 0.0) {
      share += rest > 0.0 ? 1.0 : 0.0;
      continue;
    }
    const double at = std::clamp(rest / gradient.x / extents.x + 0.5, 0.0, 1.0);
    share += gradient.x > 0.0 ? at : 1.0 - at;
  }
  return share / kRows;
}

}  // namespace limen::techniques
