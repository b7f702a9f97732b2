// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/visibility_fields/traced_triangles.h"

#include "renderer/ray_tracing/ray_scene.h"

namespace limen::techniques {
namespace {

/// Whether a part that moves has one of them; those left out have no area.
bool anyMoves(const scene::Scene& scene, const std::vector<glm::uvec3>& triangles) {
  for (const scene::PartMotion& motion : scene.motions) {
    const scene::Part& part = scene.parts[motion.part];
    for (uint32_t i = part.firstTriangle; i < part.firstTriangle + part.triangleCount; ++i)
      if (triangles[i] != glm::uvec3(triangles[i].x)) return true;
  }
  return false;
}

}  // namespace

std::vector<glm::vec3> anchoredVertices(const frame::Frame& frame) {
  std::vector<glm::vec3> out;
  for (const glm::dvec3 p : frame.scene().mesh.positions) out.emplace_back(p - frame.gpuScene().anchor());
  return out;
}

TracedTriangles::TracedTriangles(frame::Frame& frame, const std::vector<glm::uvec3>& triangles) {
  if (!anyMoves(frame.scene(), triangles)) {
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
