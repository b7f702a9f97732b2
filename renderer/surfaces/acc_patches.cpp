// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/acc_patches.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "renderer/surfaces/bernstein.h"
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

using BicubicNet = std::array<glm::dvec3, 16>;                // [i + 4 j]
using TangentNet = std::array<std::array<glm::dvec3, 4>, 3>;  // [along][across]: degree 2 and 3

/// The patch of derivatives along u of a face whose vertices are a, b (along u from a), c, d. Of the one
/// along v: the same with the face and net turned over.
TangentNet tangentPatch(const Masks& masks, const std::array<uint32_t, 4>& v, const auto& at) {
  TangentNet net;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j)
      net[static_cast<size_t>(i)][static_cast<size_t>(j)] = 3.0 * (at(i + 1, j) - at(i, j));
  net[0][0] = masks.tangent(v[0], v[1]), net[2][0] = -masks.tangent(v[1], v[0]);
  net[0][3] = masks.tangent(v[3], v[2]), net[2][3] = -masks.tangent(v[2], v[3]);
  // On the sides u = 0 and u = 1, across which these tangents point: with the neighbour's they sum to a
  // multiple of the tangent along the side (Loop and Schaefer 2008, section 4).
  const auto correct = [&](size_t column, uint32_t from, uint32_t to, double sign) {
    if (masks.isOpen(from, to)) return;
    const int i = column == 0 ? 0 : 3;
    const glm::dvec3 first = masks.tangent(from, to), middle = 3.0 * (at(i, 2) - at(i, 1)),
                     last = -masks.tangent(to, from);
    const double c0 = masks.cosine(from), c1 = masks.cosine(to);
    net[column][1] += sign / 3.0 * (2.0 * c0 * middle - c1 * first);
    net[column][2] += sign / 3.0 * (c0 * last - 2.0 * c1 * middle);
  };
  correct(0, v[0], v[3], 1.0);
  correct(2, v[1], v[2], -1.0);
  return net;
}

/// Cross product of two tangent patches, [i + 6 j].
std::array<glm::dvec3, 36> crossProduct(const TangentNet& alongU, const TangentNet& alongV) {
  std::array<glm::dvec3, 36> out{};
  const auto term = [](size_t n, size_t i, size_t m, size_t k) {
    return binomial(n, i) * binomial(m, k) / binomial(n + m, i + k);
  };
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 4; ++j)
      for (size_t k = 0; k < 4; ++k)
        for (size_t l = 0; l < 3; ++l)
          // alongV[l][k] goes with v^l and u^k.
          out[(i + k) + 6 * (j + l)] +=
              term(2, i, 3, k) * term(3, j, 2, l) * glm::cross(alongU[i][j], alongV[l][k]);
  return out;
}

}  // namespace

PatchSet accPatches(const PolygonMesh& mesh, AccNormals normals) {
  const Masks masks(mesh);
  PatchSet set;
  for (uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const std::vector<uint32_t>& v = mesh.faces[f];
    const auto edge = [&](size_t from, size_t to) { return masks.edge(v[from], v[to]); };
    const BicubicNet net = {masks.corner(v[0]), edge(0, 1),        edge(1, 0),        masks.corner(v[1]),
                            edge(0, 3),         masks.inner(f, 0), masks.inner(f, 1), edge(1, 2),
                            edge(3, 0),         masks.inner(f, 3), masks.inner(f, 2), edge(2, 1),
                            masks.corner(v[3]), edge(3, 2),        edge(2, 3),        masks.corner(v[2])};
    std::array<glm::dvec4, 16> points;
    for (size_t i = 0; i < 16; ++i) points[i] = glm::dvec4(net[i], 1.0);
    if (normals == AccNormals::Geometry) {
      addRectangle(set, 3, 3, points);
      continue;
    }
    const TangentNet alongU = tangentPatch(masks, {v[0], v[1], v[2], v[3]},
                                           [&](int i, int j) { return net[static_cast<size_t>(i + 4 * j)]; });
    const TangentNet alongV = tangentPatch(masks, {v[0], v[3], v[2], v[1]},
                                           [&](int i, int j) { return net[static_cast<size_t>(j + 4 * i)]; });
    addRectangle(set, 3, 3, points, 5, crossProduct(alongU, alongV));
  }
  findNeighbours(set);
  return set;
}

}  // namespace limen::surfaces
