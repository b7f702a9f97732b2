// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "renderer/surfaces/polygon_mesh.h"

namespace limen::surfaces {

/// Control points by face and corner, from which those of edges and corners follow as means.
class AccMasks {
 public:
  explicit AccMasks(const PolygonMesh& mesh) : mesh_(mesh), topology_(mesh) {
    for (uint32_t f = 0; f < mesh.faces.size(); ++f) {
      const std::vector<uint32_t>& face = mesh.faces[f];
      if (face.size() != 4) throw std::invalid_argument("a face is no quad");
      for (size_t c = 0; c < 4; ++c) {
        const auto n = double(topology_.rings()[face[c]].faces.size());
        const glm::dvec3 sides = mesh.points[face[(c + 1) % 4]] + mesh.points[face[(c + 3) % 4]];
        inner_.push_back((n * mesh.points[face[c]] + 2.0 * sides + mesh.points[face[(c + 2) % 4]]) /
                         (n + 5.0));
      }
    }
    for (uint32_t v = 0; v < mesh.points.size(); ++v) corners_.push_back(cornerPoint(v));
  }

  glm::dvec3 inner(uint32_t face, size_t corner) const { return inner_[4 * face + corner]; }
  glm::dvec3 corner(uint32_t vertex) const { return corners_[vertex]; }

  /// Derivative of the surface at `from` along the edge to `to`, in the limit of subdivision; at boundaries
  /// that of the patches.
  glm::dvec3 tangent(uint32_t from, uint32_t to) const {
    const VertexRing& ring = topology_.rings()[from];
    if (!ring.closed) return 3.0 * (edge(from, to) - corner(from));
    const size_t n = ring.faces.size();
    const auto start =
        static_cast<size_t>(std::find(ring.edges.begin(), ring.edges.end(), to) - ring.edges.begin());
    const double turn = 2.0 * std::numbers::pi / double(n), half = std::cos(0.5 * turn);
    const double diagonal = 1.0 / (double(n) * std::sqrt(4.0 + half * half));
    glm::dvec3 sum(0.0);
    for (size_t i = 0; i < n; ++i) {
      const size_t at = (start + i) % n;
      sum += (1.0 / double(n) + half * diagonal) * std::cos(turn * double(i)) * mesh_.points[ring.edges[at]];
      const std::vector<uint32_t>& face = mesh_.faces[ring.faces[at]];
      const auto own = static_cast<size_t>(std::find(face.begin(), face.end(), from) - face.begin());
      sum += diagonal * std::cos(turn * (double(i) + 0.5)) * mesh_.points[face[(own + 2) % 4]];
    }
    return sum;
  }
  /// The sum of the tangents across an edge, one from each side, is that along it times twice this at its
  /// end.
  double cosine(uint32_t vertex) const {
    const VertexRing& ring = topology_.rings()[vertex];
    return ring.closed ? std::cos(2.0 * std::numbers::pi / double(ring.faces.size())) : 0.0;
  }
  bool isOpen(uint32_t a, uint32_t b) const {
    const std::array<int32_t, 2>& sides = topology_.edges().at(edgeKey(a, b));
    return sides[0] < 0 || sides[1] < 0;
  }

  /// Next to `from` on the edge to `to`: the mean of the inner points on either side.
  glm::dvec3 edge(uint32_t from, uint32_t to) const {
    const std::array<int32_t, 2>& sides = topology_.edges().at(edgeKey(from, to));
    if (sides[0] < 0 || sides[1] < 0) return (2.0 * mesh_.points[from] + mesh_.points[to]) / 3.0;
    return 0.5 *
           (innerAt(static_cast<uint32_t>(sides[0]), from) + innerAt(static_cast<uint32_t>(sides[1]), from));
  }

 private:
  glm::dvec3 innerAt(uint32_t face, uint32_t vertex) const {
    size_t c = 0;
    while (mesh_.faces[face][c] != vertex) ++c;
    return inner(face, c);
  }
  glm::dvec3 cornerPoint(uint32_t v) const {
    const VertexRing& ring = topology_.rings()[v];
    if (ring.faces.empty() || (!ring.closed && ring.faces.size() == 1)) return mesh_.points[v];
    if (!ring.closed)
      return (4.0 * mesh_.points[v] + mesh_.points[ring.edges.front()] + mesh_.points[ring.edges.back()]) /
             6.0;
    glm::dvec3 sum(0.0);
    for (const uint32_t face : ring.faces) sum += innerAt(face, v);
    return sum / double(ring.faces.size());
  }

  const PolygonMesh& mesh_;
  MeshTopology topology_;
  std::vector<glm::dvec3> inner_, corners_;
};

}  // namespace limen::surfaces
