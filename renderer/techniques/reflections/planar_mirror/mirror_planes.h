// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/frame/shown_mirrors.h"
#include "renderer/scene/scene.h"

namespace limen::techniques {

/// Planes in which mirroring triangles lie.
struct MirrorPlanes {
  static constexpr uint32_t kNone = 0xffffffffU;
  /// dot(plane.xyz, p) + plane.w = 0, unit normal, relative to the anchor; the one with the largest area
  /// first.
  std::vector<glm::dvec4> planes;
  std::vector<uint32_t> planeOf;  ///< of each triangle; kNone: no mirror, or in none of the planes
};

/// The `most` planes that hold the largest area of mirrors. A triangle belongs to the first plane found whose
/// distance from its corners is below 2^-20 of the scene's size and whose normal is its own up to 1e-4;
/// triangles without area to none. Of `shown` mirrors.
MirrorPlanes findMirrorPlanes(const scene::Scene& scene, glm::dvec3 anchor, int most,
                              const frame::ShownMirrors& shown = {});

/// Reflection at a plane.
glm::dmat4 mirrorMatrix(glm::dvec4 plane);

}  // namespace limen::techniques
