// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/qas_patches.h"

#include "renderer/surfaces/loop_subdivision.h"
#include "renderer/surfaces/neighbours.h"
#include "renderer/surfaces/patch_builder.h"

namespace limen::surfaces {

PatchSet qasPatches(const PolygonMesh& mesh) {
  const PolygonMesh fine = loop(mesh);
  const LoopLimit limit = loopLimit(fine);
  PatchSet set;
  // Through the middle: 2 p - (a + b) / 2, the same bits from both ends.
  const auto control = [](glm::dvec3 middle, glm::dvec3 a, glm::dvec3 b) {
    return 2.0 * middle - 0.5 * (a + b);
  };
  for (uint32_t f = 0; f < mesh.faces.size(); ++f) {
    std::array<glm::dvec3, 3> corners, middles, normals, middleNormals;
    for (uint32_t i = 0; i < 3; ++i) {
      const uint32_t child = 4 * f + i, middle = 4 * f + 3;
      corners[i] = limit.points[fine.faces[child][0]], normals[i] = limit.normals[child][0];
      middles[i] = limit.points[fine.faces[middle][i]], middleNormals[i] = limit.normals[middle][i];
    }
    std::array<glm::dvec3, 3> b, n;
    for (size_t i = 0; i < 3; ++i) {
      const size_t next = (i + 1) % 3;
      b[i] = control(middles[i], corners[i], corners[next]);
      n[i] = control(middleNormals[i], normals[i], normals[next]);
    }
    const std::array<glm::dvec4, 6> points = {glm::dvec4(corners[0], 1.0), glm::dvec4(b[0], 1.0),
                                              glm::dvec4(b[2], 1.0),       glm::dvec4(corners[1], 1.0),
                                              glm::dvec4(b[1], 1.0),       glm::dvec4(corners[2], 1.0)};
    const std::array<glm::dvec3, 6> field = {normals[0], n[0], n[2], normals[1], n[1], normals[2]};
    addTriangle(set, 2, points, 2, field);
  }
  findNeighbours(set);
  return set;
}

}  // namespace limen::surfaces
