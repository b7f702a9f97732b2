// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/visibility_fields/traced_triangles.h"

#include "renderer/ray_tracing/ray_scene.h"

namespace limen::techniques {

std::vector<glm::vec3> anchoredVertices(const frame::Frame& frame) {
  std::vector<glm::vec3> out;
  for (const glm::dvec3 p : frame.scene().mesh.positions) out.emplace_back(p - frame.gpuScene().anchor());
  return out;
}

TracedTriangles::TracedTriangles(frame::Frame& frame, const std::vector<glm::uvec3>& triangles) {
  if (frame.scene().motions.empty()) {
    tree_ = std::make_unique<ray_tracing::RayScene>(frame.context(), anchoredVertices(frame), triangles);
    return;
  }
  auto rebuilt =
      std::make_unique<ray_tracing::RebuiltTree>(frame.context(), static_cast<uint32_t>(triangles.size()));
  rebuilt_ = rebuilt.get();
  tree_ = std::move(rebuilt);
  indices_.emplace(triangles);
}

void TracedTriangles::update(frame::Frame& frame) const {
  if (rebuilt_) rebuilt_->build(frame.passes(), frame.positions(), *indices_);
}

}  // namespace limen::techniques
