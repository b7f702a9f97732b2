// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/ray_tracing/ray_scene.h"

#include <epoxy/gl.h>

#include <chrono>
#include <string>

#include "experiments/base/error.h"
#include "renderer/ray_tracing/ray_tracing_bindings.h"

namespace limen::ray_tracing {
namespace {

template <class T>
gl::Buffer upload(const std::vector<T>& data) {
  GLint64 most = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
  const auto bytes = static_cast<int64_t>(data.size() * sizeof(T));
  if (bytes > most)
    throw Error("a tree for rays takes " + std::to_string(bytes) +
                    " bytes in one buffer; this device allows " + std::to_string(most),
                {}, "use a smaller scene, or trace rays on the CPU");
  return gl::Buffer(data);
}

}  // namespace

RayScene::RayScene(gl::Context& context, const WideBvh& tree, double buildS)
    : mostIterations_(context.device().software ? 60000 : 0x7fffffff),
      levels_(tree.levels()),
      nodeCount_(static_cast<uint32_t>(tree.nodes().size())),
      triangleCount_(static_cast<uint32_t>(tree.triangles().size())),
      buildS_(buildS),
      nodes_(upload(tree.nodes())),
      triangles_(upload(tree.triangles())) {}

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
