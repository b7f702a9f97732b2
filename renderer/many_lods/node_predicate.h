// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "renderer/many_lods/many_lods_bindings.h"

namespace limen::many_lods {

/// Sets what a view can see and how large things are in it: a tile of `sidePx` pixels, a node being fine
/// enough if its sphere's diameter is less than `epsilonPx` pixels. Pixels of a hemisphere, whose projection
/// is stereographic, have the size that they have on average over the directions; those of a perspective view
/// that of its middle. `axisZ`, `axisY` are made perpendicular. `range`: farthest depth of interest.
CutView hemisphereView(glm::dvec3 eye, glm::dvec3 axisZ, int sidePx, double epsilonPx, double range);
CutView perspectiveView(glm::dvec3 eye, glm::dvec3 axisZ, glm::dvec3 down, glm::dvec2 tanHalfFov,
                        int heightPx, double epsilonPx, double range);

/// A node is valid if it is a leaf, if its diameter in pixels is less than epsilon (a sphere that the eye is
/// in has no size that is), or if it is wholly outside the view (culled: size 0). Exact comparison belongs to
/// the coarse side: valid is "<". Where a node's spheres are made by mergedSphere(), children of valid nodes
/// are valid, for all floats: with u = 2^-24, the squares compared err by at most 5 u; a parent is larger
/// than its child's sphere by the share kSphereSlack > 16 u, and q >= 1. Planes err by less than 12 u of the
/// distance; the test for culling gives way by kCullSlack = 32 u of it less for a child. Source: Holländer
/// 2013, section 3.3 (the size), with monotony as the bench's own.
bool isValid(glm::vec4 sphere, uint32_t node, uint32_t leaves, const CutView& view);
bool isCulled(glm::vec4 sphere, uint32_t node, uint32_t leaves, const CutView& view);
/// Diameter in pixels over epsilon, in double precision; infinite from within.
double relativeSize(glm::vec4 sphere, const CutView& view);

}  // namespace limen::many_lods
