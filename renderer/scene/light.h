// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "renderer/scene/scene.h"

namespace limen::scene {

/// Signed area of a polygon, positive if counter-clockwise.
double signedArea(const std::vector<glm::dvec2>& polygon);

/// True if `point` lies in the simple polygon or on its boundary. A point nearer to an edge than the rounding
/// error of the orientation test counts as lying on it.
bool polygonContains(const std::vector<glm::dvec2>& polygon, glm::dvec2 point);

/// The light's outline in unit light coordinates, counter-clockwise. A disc is given by `discVertices` points
/// on its edge, so the polygon lies inside the ellipse.
std::vector<glm::dvec2> lightOutline(const AreaLight& light, int discVertices = 64);

/// Throws Error, naming `where`, if the light is degenerate: extents that are not positive, axes that are not
/// unit and perpendicular, no part, a radiance that is negative or not finite, an outline (its own or a
/// part's) that leaves [0,1]^2, has no area, is clockwise, repeats a vertex or crosses itself.
void checkLight(const AreaLight& light, const std::string& where);

/// `light` with another shape but the same extents. A polygon is a hexagon that touches all four sides.
AreaLight withShape(AreaLight light, LightShape shape);

}  // namespace limen::scene
