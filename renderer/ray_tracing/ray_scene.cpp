// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/ray_tracing/ray_scene.h"

#include <chrono>

#include "renderer/ray_tracing/ray_tracing_bindings.h"
#include "renderer/ray_tracing/tree_upload.h"

namespace limen::ray_tracing {

RayScene::RayScene(gl::Context& context, const WideBvh& tree, double buildS)
    : mostIterations_(mostRayIterations(context)),
      levels_(tree.levels()),
      nodeCount_(static_cast<uint32_t>(tree.nodes().size())),
      triangleCount_(static_cast<uint32_t>(tree.triangles().size())),
      buildS_(buildS),
      nodes_(uploadTree(tree.nodes())),
      triangles_(uploadTree(tree.triangles())) {}

RayScene RayScene::build(gl::Context& context, const std::vector<glm::vec3>& vertices,
                         const std::vector<glm::uvec3>& triangles) {
  const auto start = std::chrono::steady_clock::now();
  const WideBvh tree(vertices, triangles);
  return {context, tree, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()};
}

RayScene::RayScene(gl::Context& context, const std::vector<glm::vec3>& vertices,
                   const std::vector<glm::uvec3>& triangles)
    : RayScene(build(context, vertices, triangles)) {}

void RayScene::bind(const gl::Program& program) const {
  nodes_.bindStorage(kRayNodesBuffer);
  triangles_.bindStorage(kRayTrianglesBuffer);
  program.set("rayNodeCount", nodeCount_);
  program.set("maxRayIterations", mostIterations_);
}

}  // namespace limen::ray_tracing
