// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "renderer/scene/scene.h"
#include "renderer/techniques/reflections/vertex_reflection/star_surface.h"

namespace limen::reflections {

/// From where a run of triangles is seen as a whole.
struct StarCentre {
  glm::dvec3 position{0.0};
  bool inside = false;  ///< the triangles' fronts (counter-clockwise) face the centre, as those of a bowl
  /// Least cosine between a triangle's normal, turned to the same side for all, and the line from the centre;
  /// star-shaped from here: > 0.
  double leastCosine = -1.0;
  double meanRadius = 0.0;  ///< mean distance of the vertices
};

/// The better of the bounds' middle and the middle of the sphere that fits the vertices, improved by a search
/// where neither sees all triangles. Triangles without area do not count.
StarCentre findStarCentre(const scene::Mesh& mesh, scene::TriangleRange triangles);

/// Triangles as a surface around a centre: the radius is that of the nearest triangle along the direction,
/// the gradient that of the vertex normals, interpolated, where the mesh has any. Radius 0 where no triangle
/// is.
class StarMesh {
 public:
  StarMesh(const scene::Mesh& mesh, scene::TriangleRange triangles, glm::dvec3 centre);
  RadialPoint at(glm::dvec3 direction) const;
  /// Keeps the mesh alive.
  static StarSurface surface(std::shared_ptr<const StarMesh> mesh);

 private:
  struct Corner {
    glm::dvec3 position, normal;
  };
  static constexpr int kCells = 48;  ///< along the side of a face of a cube around the centre
  std::vector<std::array<Corner, 3>> triangles_;
  std::vector<std::vector<uint32_t>> cells_;
};

/// Face (0 to 5: +x, -x, +y, -y, +z, -z) of a cube around the origin and coordinates there, -1 to 1, as cube
/// maps of OpenGL have them (4.5, table 8.19).
struct CubePlace {
  int face = 0;
  double s = 0.0, t = 0.0;
};
CubePlace cubePlace(glm::dvec3 direction);
/// Not normalised.
glm::dvec3 cubeDirection(const CubePlace& place);

}  // namespace limen::reflections
