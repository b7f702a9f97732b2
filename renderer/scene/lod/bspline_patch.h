// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "renderer/scene/lod_set.h"

namespace limen::scene {

/// Point, derivatives and unnormalised normal of a bicubic B-spline patch, 0 <= u, v <= 1.
glm::dvec3 patchPoint(const BicubicPatch& patch, double u, double v);
glm::dvec3 patchAlongU(const BicubicPatch& patch, double u, double v);
glm::dvec3 patchAlongV(const BicubicPatch& patch, double u, double v);
inline glm::dvec3 patchNormal(const BicubicPatch& patch, double u, double v) {
  return glm::cross(patchAlongU(patch, u, v), patchAlongV(patch, u, v));
}

/// factor x factor cells of two triangles with their corners on the patch; the diagonals run from (0, 0) to
/// (1, 1). Unit normals, and (u, v) in attributes.xy, at the vertices.
Mesh tessellated(const BicubicPatch& patch, int factor);

/// The point of tessellated(patch, factor) that belongs to the parameters (u, v).
glm::dvec3 tessellatedPoint(const BicubicPatch& patch, int factor, double u, double v);

/// Levels by tessellation factors, descending (Schwarz 2009, section 10.4.1: 9, 3, 2).
/// deviation: sampledDeviation() from the first level. statedError: largest distance from the patch itself at
/// the same parameters, on a grid of 8 x 8 points per cell. Morph targets: the next level's point at the same
/// parameters; the surface morphs into exactly the next level if one factor divides the other.
LodSet patchLevels(const BicubicPatch& patch, const std::vector<int>& factors);

}  // namespace limen::scene
