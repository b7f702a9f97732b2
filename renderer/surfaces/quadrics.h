// SPDX-License-Identifier: BSD-3-Clause
// Exact spheres, tori and other solids of revolution as rational patches (Piegl and Tiller 1997, chapter 8).
#pragma once

#include <span>

#include "renderer/surfaces/patch_set.h"

namespace limen::surfaces {

/// A curve in the plane through the y axis, as homogeneous control points (w r, w y, w): r >= 0 is the
/// distance from the axis.
using Profile = std::vector<glm::dvec3>;

/// Quarter circle from a to c whose tangents meet at b: weights 1, sqrt(1/2), 1.
Profile quarterArc(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c);
Profile segment(glm::dvec2 a, glm::dvec2 b);
/// Polynomial curve of any degree.
Profile bezierProfile(std::span<const glm::dvec2> points);

/// Four patches around the y axis, quadratic along u around it, counter-clockwise seen from +y; v along the
/// profile. They face outwards if the profile rises along the outside. Where it meets the axis, a side is
/// collapsed. Profiles that share an end, and the four quarters, share control points bit by bit.
PatchSet revolved(const Profile& profile);

/// Eight octants, two collapsed sides and an equator in the plane y = 0; unit radius at the origin.
PatchSet unitSphere();
/// Around the y axis, 16 patches; 0 < tube < radius.
PatchSet torus(double radius, double tube);
/// Lateral surface and both caps, 12 patches, from y = 0 to y = height.
PatchSet cylinder(double radius, double height);

}  // namespace limen::surfaces
