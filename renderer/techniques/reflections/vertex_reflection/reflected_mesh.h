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
};

/// `segments` >= 1 on each edge. Throws Error if the result has more than 2^24 triangles.
ReflectedMesh divided(const scene::Mesh& mesh, int segments, glm::dvec3 anchor);

}  // namespace limen::reflections
