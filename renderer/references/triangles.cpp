// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/references/triangles.h"

#include <algorithm>
#include <cmath>

namespace limen::references {

Triangles::Triangles(const scene::Scene& scene, glm::dvec3 anchor) : indices_(scene.mesh.triangles) {
  vertices_.reserve(scene.mesh.positions.size());
  double reach = 0.0;
  for (const glm::dvec3& position : scene.mesh.positions) {
    const glm::vec3 vertex(position - anchor);
    vertices_.push_back(vertex);
    for (int axis = 0; axis < 3; ++axis)
      if (std::isfinite(vertex[axis])) reach = std::max(reach, std::abs(double(vertex[axis])));
  }
  planeTolerance_ = 0x1p-22 * reach;
}

}  // namespace limen::references
