// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/surfaces/polygon_mesh.h"

namespace limen::surfaces {

/// Control points of bicubic patches that approximate Catmull-Clark surfaces (Loop and Schaefer 2008), by
/// face and corner, from which those of edges and corners follow as means. Infinitely sharp edges and
/// boundaries divide the faces around a vertex into sectors, and each sector is treated as one half of the
/// ring of a smooth vertex (Kovacs, Mitchell, Drone and Zorin 2009): points are the surface's wherever a
/// sector has as many faces as a regular one. Semi-sharp edges count as smooth ones.
class AccMasks {
 public:
  /// Throws std::invalid_argument if a face is no quad.
  explicit AccMasks(const PolygonMesh& mesh);

  glm::dvec3 inner(uint32_t face, size_t corner) const { return inner_[4 * face + corner]; }
  glm::dvec3 corner(uint32_t vertex) const { return corners_[vertex]; }
  /// Next to `from` on the edge to `to`: the mean of the inner points on either side, or a third of the way
  /// along a sharp edge.
  glm::dvec3 edge(uint32_t from, uint32_t to) const;

  /// Derivative of the surface at `from` along the edge to `to`, in the limit of subdivision; at corners that
  /// of the patches.
  glm::dvec3 tangent(uint32_t from, uint32_t to) const;
  /// The sum of the tangents at `vertex` on either side of the edge to `end` is that along it times twice
  /// this.
  double cosine(uint32_t vertex, uint32_t end) const;
  /// Whether the surface has a crease or its boundary along an edge.
  bool isSharp(uint32_t a, uint32_t b) const;

 private:
  enum class Kind { Smooth, Crease, Corner };
  /// Faces around a vertex between sharp edges, by place in its ring.
  struct Sector {
    size_t first = 0, faces = 0;
  };
  Sector sectorOf(uint32_t vertex, size_t face) const;
  size_t placeOf(uint32_t vertex, uint32_t end) const;  ///< in the ring's edges
  uint32_t ringEdge(uint32_t vertex, size_t place) const;
  glm::dvec3 diagonal(uint32_t face, uint32_t vertex) const;
  glm::dvec3 cornerPoint(uint32_t vertex) const;
  glm::dvec3 smoothTangent(uint32_t vertex, size_t place) const;
  glm::dvec3 sectorTangent(uint32_t vertex, const Sector& sector, size_t step) const;
  glm::dvec3 innerAt(uint32_t face, uint32_t vertex) const;

  const PolygonMesh& mesh_;
  MeshTopology topology_;
  std::vector<Kind> kinds_;
  std::vector<std::vector<uint32_t>> sharp_;  ///< by vertex: far ends of its sharp edges
  std::vector<glm::dvec3> inner_, corners_;
};

}  // namespace limen::surfaces
