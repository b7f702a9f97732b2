// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "renderer/surfaces/domain_point.h"
#include "renderer/surfaces/patterns.h"
#include "renderer/surfaces/spacing.h"

namespace limen::surfaces {

/// Where a tessellated surface is looked at from, so that lengths can be stated in pixels.
struct SurfaceView {
  glm::dvec3 eye{0.0}, right{1.0, 0.0, 0.0}, up{0.0, 1.0, 0.0}, forward{0.0, 0.0, -1.0};  ///< unit, world
  glm::dvec2 tanHalf{1.0};    ///< tangents of half the fields of view, horizontal and vertical
  double pxAtDistance = 1.0;  ///< pixels of a unit length across the view at distance 1
  double nearest = 0.0;       ///< distance of the near plane
};

/// Curved surfaces as a technique has drawn them.
struct TessellatedSurface {
  glm::dvec3 anchor{0.0};
  std::vector<glm::vec3> positions;  ///< as the GPU had them, relative to the anchor
  std::vector<glm::vec3> normals;
  std::vector<DomainPoint> parameters;  ///< of each vertex on its patch
  std::vector<uint32_t> patches;        ///< of each vertex; a triangle's vertices are of one patch
  std::vector<glm::uvec3> triangles;    ///< counter-clockwise in the domain
  std::vector<Factors> factors;         ///< of each patch; 0: culled or left out
  SurfaceView view;
  std::shared_ptr<const PatchSet> moved;  ///< the surfaces when they were drawn, if they move
};

/// Place on the surface for a pattern's vertex.
inline DomainPoint domainPointOf(const PatternPlan& plan, int slot) {
  const ivec4 s = patternSample(plan, slot);
  return plan.rectangle == 1 ? DomainPoint{double(s.x) / s.y, double(s.z) / s.w, double(s.y - s.x) / s.y,
                                           double(s.w - s.z) / s.w}
                             : triangleGridPoint(s.x, s.y, s.w);
}

/// The same with a side's real factors, in 1 / kSegmentUnit, that `spacing` divides.
inline DomainPoint spacedPointOf(const PatternPlan& plan, int slot, int spacing, ivec4 units) {
  if (plan.rectangle == 0) return domainPointOf(plan, slot);
  const ivec4 s = patternSample(plan, slot);
  const int side = sideOfSample(1, s), u = unitsAlong(units, side, 0), v = unitsAlong(units, side, 1);
  return {spacedPlace(spacing, u, s.x, s.y), spacedPlace(spacing, v, s.z, s.w),
          spacedPlace(spacing, u, s.y - s.x, s.y), spacedPlace(spacing, v, s.w - s.z, s.w)};
}

}  // namespace limen::surfaces
