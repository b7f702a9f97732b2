// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "renderer/scene/scene.h"

/// What decides which technique a reflector needs, measured from the scene's triangles, in double precision.
namespace limen::techniques {

/// A part whose material reflects. Triangles without area count nowhere.
struct ReflectorFacts {
  uint32_t part = 0;  ///< of Scene::parts
  std::string name;
  double areaShare = 0.0;  ///< of all mirrors' area
  /// Planes in which its triangles lie, with vertex normals that are the planes' own up to 0.001 rad; 0:
  /// vertex normals make it look curved.
  int planes = 0;
  /// Distance from the middle of its box to the nearest triangle of any other part, in radii of the sphere
  /// around that middle; infinite where there is no other part. Seen from any point of the reflector instead
  /// of the middle, what surrounds it turns by asin(1 / surroundings) at most.
  double surroundings = 0.0;
  bool star = false;  ///< some point sees it as a whole
  /// Part of the edges' turn (angle between neighbouring triangles, weighted by the edge's length) that is
  /// concave, seen from the triangles' fronts: 0 for convex reflectors. Turns below 1e-6 rad count nowhere.
  double concaveShare = 0.0;
  /// Share of the edges' length at which the normals of the two sides differ by more than the crease's angle.
  double creasedShare = 0.0;
  double glossRad = 0.0;  ///< of its material
};

/// Of each reflecting part that has any area. `creaseDeg`: see ReflectorFacts::creasedShare.
std::vector<ReflectorFacts> measureReflectors(const scene::Scene& scene, double creaseDeg);

/// Distance from `point` to the nearest point of the triangle; of its corners alone where it has no area.
double distanceToTriangle(glm::dvec3 point, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c);

}  // namespace limen::techniques
