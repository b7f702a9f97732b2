// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "renderer/frame/shadow_map.h"

namespace limen::frame {
namespace {

constexpr double kMaxTangent = 3.7320508075688772;  // 75 degrees
constexpr double kNearShare = 1e-3;

}  // namespace

glm::dmat4 LightFrustum::clipFromLight() const {
  const glm::dvec2 scale = 2.0 / (high - low);
  const glm::dvec2 shift = -(high + low) / (high - low);
  glm::dmat4 clip(0.0);
  // Row 0 of the target is the top of clip space, and rows are to grow with y: hence the minus in y.
  clip[0][0] = scale.x, clip[2][0] = shift.x, clip[3][0] = -scale.x * offset.x;
  clip[1][1] = -scale.y, clip[2][1] = -shift.y, clip[3][1] = scale.y * offset.y;
  clip[3][2] = near;
  clip[2][3] = 1.0;
  return clip;
}

LightCasters::LightCasters(const scene::Scene& scene, int chosen) {
  const glm::dmat4 toLight = scene.lights.at(0).toLightSpace();
  for (size_t number = 0; number < scene.parts.size(); ++number) {
    const scene::Part& part = scene.parts[number];
    if (part.receiverOnly || (chosen >= 0 && static_cast<size_t>(chosen) != number)) continue;
    for (uint32_t i = part.firstTriangle; i < part.firstTriangle + part.triangleCount; ++i)
      for (int corner = 0; corner < 3; ++corner) {
        const glm::dvec3 position = scene.mesh.positions[scene.mesh.triangles[i][corner]];
        vertices_.emplace_back(toLight * glm::dvec4(position, 1.0));
        farthest_ = std::max(farthest_, vertices_.back().z);
      }
  }
}

LightFrustum LightCasters::fit(glm::dvec2 offset, int resolution) const {
  LightFrustum frustum;
  frustum.offset = offset;
  const double nearLimit = kNearShare * (farthest_ > 0.0 ? farthest_ : 1.0);
  frustum.near = nearLimit;
  glm::dvec2 low(kMaxTangent), high(-kMaxTangent);
  double nearest = farthest_;
  const auto include = [&](const glm::dvec3& q) {
    const glm::dvec2 tangent = (glm::dvec2(q) - offset) / q.z;
    low = glm::min(low, tangent), high = glm::max(high, tangent);
    nearest = std::min(nearest, q.z);
  };
  for (size_t i = 0; i + 2 < vertices_.size(); i += 3)
    for (size_t corner = 0; corner < 3; ++corner) {
      const glm::dvec3 &a = vertices_[i + corner], &b = vertices_[i + (corner + 1) % 3];
      if (a.z >= nearLimit) include(a);
      // An edge through the near limit leaves the visible half-space there.
      if ((a.z < nearLimit) != (b.z < nearLimit))
        include(a + (b - a) * ((nearLimit - a.z) / (b.z - a.z)) + glm::dvec3(0, 0, 1e-12 * nearLimit));
    }
  if (low.x > high.x || low.y > high.y) return frustum;  // no caster in front of the light
  frustum.castersCut = glm::any(glm::lessThan(glm::min(low, -high), glm::dvec2(-kMaxTangent)));
  low = glm::max(low, -kMaxTangent), high = glm::min(high, kMaxTangent);
  low = glm::min(low, high);
  // A flat caster still needs a map with an area; then one texel of margin, so that the edge texels are
  // empty.
  const glm::dvec2 centre = 0.5 * (low + high);
  glm::dvec2 half = glm::max(0.5 * (high - low), 1e-6);
  half *= resolution > 2 ? double(resolution) / (resolution - 2) : 1.0 + 1e-6;
  frustum.low = centre - half, frustum.high = centre + half;
  frustum.near = std::max(nearLimit, nearest * 0.999);
  return frustum;
}

}  // namespace limen::frame
