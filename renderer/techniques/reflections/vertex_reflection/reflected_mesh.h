// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/scene/scene.h"

namespace limen::reflections {

/// A scene's triangles, each divided evenly: what is reflected, at one level of tessellation. Vertices are
/// shared as in the scene, along its edges too, so that no cracks come from here.
struct ReflectedMesh {
  std::vector<glm::vec3> positions;  ///< relative to `anchor`
  std::vector<glm::uvec3> triangles;
  std::vector<uint32_t> sources;  ///< for each triangle that of the scene
  int perTriangle = 1;            ///< of each of the scene, in order
  /// For each triangle of the scene, and at the end, the number of vertices that those before it have:
  /// vertices are numbered in the order of their first use.
  std::vector<uint32_t> firstVertices;

  struct Range {
    uint32_t first = 0, count = 0;
  };
  /// Vertices that no triangle needs but the given ones of the scene; empty if others share some.
  Range ownVertices(uint32_t firstTriangle, uint32_t triangleCount) const;
};

/// `segments` >= 1 on each edge. Throws Error if the result has more than 2^24 triangles.
ReflectedMesh divided(const scene::Mesh& mesh, int segments, glm::dvec3 anchor);

}  // namespace limen::reflections
