// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <span>

#include "renderer/scene/scene.h"

namespace limen::scene {

/// Plane grid facing +y, cells x cells squares, vertices shared.
Mesh planeGrid(glm::dvec3 centre, double sizeX, double sizeZ, int cells);

/// One parallelogram, centre +- halfA +- halfB, facing cross(halfA, halfB).
Mesh card(glm::dvec3 centre, glm::dvec3 halfA, glm::dvec3 halfB);

/// As card(), in cells x cells parallelograms.
Mesh cardGrid(glm::dvec3 centre, glm::dvec3 halfA, glm::dvec3 halfB, int cells);

/// Closed: eight corners, four below and four above in the same order, counter-clockwise seen from above.
Mesh hexahedron(const std::array<glm::dvec3, 8>& corners);

/// Closed, axis-parallel.
Mesh box(glm::dvec3 low, glm::dvec3 high);

/// Closed. Octahedron with `cells` segments on each edge, pushed onto the sphere: 8 cells^2 triangles.
Mesh sphere(glm::dvec3 centre, double radius, int cells);

/// Closed, with caps. Straight from `base` to `top`; a radius of 0 at the top makes a cone.
Mesh frustum(glm::dvec3 base, glm::dvec3 top, double baseRadius, double topRadius, int segments);

/// Closed, with caps. A round tube along the line through `points` (at least two, neighbours apart), with one
/// radius > 0 each; its cross-section turns with the line and never twists about it.
Mesh tube(std::span<const glm::dvec3> points, std::span<const double> radii, int segments);

/// Vertices without normals or attributes get zeros if the other mesh has them; missing morph targets become
/// the vertex positions.
void append(Mesh& to, const Mesh& mesh);

/// Unit vector perpendicular to the unit vector `direction`.
glm::dvec3 perpendicular(glm::dvec3 direction);

/// Uniform numbers that are the same with every standard library.
class Random {
 public:
  explicit Random(int64_t seed) : engine_(static_cast<uint64_t>(seed)) {}
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }
  /// On the unit sphere.
  glm::dvec3 direction();

 private:
  std::mt19937_64 engine_;
};

}  // namespace limen::scene
