// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/acc_patches.h"

#include <stdexcept>

#include "renderer/surfaces/neighbours.h"
#include "renderer/surfaces/patch_builder.h"

namespace limen::surfaces {
namespace {

/// Control points by face and corner, from which those of edges and corners follow as means.
class Masks {
 public:
  explicit Masks(const PolygonMesh& mesh) : mesh_(mesh), topology_(mesh) {
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

}  // namespace

PatchSet accPatches(const PolygonMesh& mesh) {
  const Masks masks(mesh);
  PatchSet set;
  for (uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const std::vector<uint32_t>& v = mesh.faces[f];
    const auto edge = [&](size_t from, size_t to) { return masks.edge(v[from], v[to]); };
    const std::array<glm::dvec3, 16> net = {
        masks.corner(v[0]), edge(0, 1), edge(1, 0), masks.corner(v[1]), edge(0, 3),        masks.inner(f, 0),
        masks.inner(f, 1),  edge(1, 2), edge(3, 0), masks.inner(f, 3),  masks.inner(f, 2), edge(2, 1),
        masks.corner(v[3]), edge(3, 2), edge(2, 3), masks.corner(v[2])};
    std::array<glm::dvec4, 16> points;
    for (size_t i = 0; i < 16; ++i) points[i] = glm::dvec4(net[i], 1.0);
    addRectangle(set, 3, 3, points);
  }
  findNeighbours(set);
  return set;
}

}  // namespace limen::surfaces
