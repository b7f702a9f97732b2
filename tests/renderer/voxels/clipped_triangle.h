// SPDX-License-Identifier: BSD-3-Clause
// Whether a triangle meets a box, found by cutting the triangle with the box's sides: independent of
// separating axes.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace limen::voxels {

/// Voxel grown by `slack` on all sides (negative: shrunk); positions in voxels.
inline bool clippedMeets(const glm::dvec3 (&corners)[3], glm::ivec3 voxel, double slack) {
  std::vector<glm::dvec3> polygon(corners, corners + 3);
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      const double plane = voxel[axis] + 0.5 + side * (0.5 + slack);
      std::vector<glm::dvec3> kept;
      for (size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double outA = side * (a[axis] - plane), outB = side * (b[axis] - plane);
        if (outA <= 0.0) kept.push_back(a);
        if ((outA < 0.0 && outB > 0.0) || (outA > 0.0 && outB < 0.0))
          kept.push_back(a + outA / (outA - outB) * (b - a));
      }
      polygon = kept;
    }
  return !polygon.empty();
}

}  // namespace limen::voxels
