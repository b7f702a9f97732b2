// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <embree3/rtcore.h>

#include <span>

#include "renderer/references/receiver_points.h"
#include "renderer/references/triangles.h"

namespace limen::references {

/// Ray tracing of a scene's triangles with Embree: robust traversal, best build quality.
///
/// A shadow ray starts on a known triangle. Embree works in float, so a ray whose origin is rounded by half a
/// unit in the last place may hit its own surface or, near an edge, a neighbour of it. Offsetting the origin
/// from the surface would lose contact shadows, so hits are filtered instead. A hit does not count if
///  - its triangle is the one that the ray starts on, or its plane contains the origin
///  (Triangles::planeTolerance): seen from there it is edge-on and hides nothing;
///  - it is near the origin and the double-precision test of the exact origin against that triangle finds no
///  hit.
/// Far hits rely on Embree alone, whose robust mode leaves no cracks between triangles.
class EmbreeScene {
 public:
  /// `triangles` must outlive it. Throws std::runtime_error if Embree fails.
  explicit EmbreeScene(const Triangles& triangles);
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  /// True if a triangle lies between the point and `light` (relative to the anchor).
  bool occluded(const ReceiverPoint& from, glm::dvec3 light) const;

  /// Rays that are traced together.
  static constexpr size_t kPacket = 16;
  /// How many of `lights`, kPacket at most, are hidden from the point: the same as one by one.
  uint32_t countOccluded(const ReceiverPoint& from, std::span<const glm::dvec3> lights) const;

 private:
  const Triangles& triangles_;
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
};

}  // namespace limen::references
