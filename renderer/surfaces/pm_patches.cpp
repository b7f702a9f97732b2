// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/pm_patches.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "renderer/surfaces/neighbours.h"
#include "renderer/surfaces/patch_builder.h"

namespace limen::surfaces {
namespace {

using glm::dvec3;

/// Limit points and tangents of the vertices of a closed mesh of any faces.
class PolygonMasks {
 public:
  explicit PolygonMasks(const PolygonMesh& mesh) : mesh_(mesh), topology_(mesh) {
    for (const std::vector<uint32_t>& face : mesh.faces) {
      if (face.size() > 5) throw std::invalid_argument("a face has more than five sides");
      dvec3 sum(0.0);
      for (const uint32_t v : face) sum += mesh.points[v];
      middles_.push_back(sum / double(face.size()));
    }
    for (const VertexRing& ring : topology_.rings())
      if (!ring.closed) throw std::invalid_argument("the mesh is open");
    for (uint32_t v = 0; v < mesh.points.size(); ++v) {
      dvec3 sum(0.0);
      const VertexRing& ring = topology_.rings()[v];
      for (size_t i = 0; i < ring.faces.size(); ++i) sum += inner(v, i);
      corners_.push_back(ring.faces.empty() ? mesh.points[v] : sum / double(ring.faces.size()));
    }
  }

  dvec3 corner(uint32_t vertex) const { return corners_[vertex]; }
  double cosine(uint32_t vertex) const {
    return std::cos(2.0 * std::numbers::pi / double(topology_.rings()[vertex].faces.size()));
  }

  /// Derivatives along edges: on either side of one they sum to twice the cosine times its own.
  dvec3 tangent(uint32_t from, uint32_t to) const {
    const VertexRing& ring = topology_.rings()[from];
    const size_t n = ring.faces.size(), start = placeOf(ring.edges, to);
    const double turn = 2.0 * std::numbers::pi / double(n), half = std::cos(0.5 * turn);
    const double across = 1.0 / (double(n) * std::sqrt(4.0 + half * half));
    dvec3 sum(0.0);
    for (size_t i = 0; i < n; ++i) {
      const size_t at = (start + i) % n;
      sum += (1.0 / double(n) + half * across) * std::cos(turn * double(i)) * mesh_.points[ring.edges[at]];
      sum += across * std::cos(turn * (double(i) + 0.5)) * opposite(from, at);
    }
    return sum;
  }

  /// How far the inner points of a face and of its neighbour lie apart beside an edge, halved; for quads.
  dvec3 besideEdge(uint32_t face, uint32_t from, uint32_t to) const {
    const VertexRing& ring = topology_.rings()[from];
    const size_t n = ring.faces.size(), own = placeOf(ring.faces, face), edge = placeOf(ring.edges, to);
    const size_t other = own == edge ? (own + n - 1) % n : edge;
    return 0.5 * (inner(from, own) - inner(from, other));
  }
  bool areQuads(uint32_t a, uint32_t b) const {
    const std::array<int32_t, 2>& sides = topology_.edges().at(edgeKey(a, b));
    return mesh_.faces[size_t(sides[0])].size() == 4 && mesh_.faces[size_t(sides[1])].size() == 4;
  }

 private:
  template <class List>
  static size_t placeOf(const List& list, uint32_t what) {
    return size_t(std::find(list.begin(), list.end(), what) - list.begin());
  }
  /// What a quad would have across its diagonal.
  dvec3 opposite(uint32_t v, size_t i) const {
    const VertexRing& ring = topology_.rings()[v];
    return 4.0 * middles_[ring.faces[i]] - mesh_.points[v] - mesh_.points[ring.edges[i]] -
           mesh_.points[ring.edges[(i + 1) % ring.edges.size()]];
  }
  dvec3 inner(uint32_t v, size_t i) const {
    const VertexRing& ring = topology_.rings()[v];
    const auto n = double(ring.faces.size());
    const dvec3 sides = mesh_.points[ring.edges[i]] + mesh_.points[ring.edges[(i + 1) % ring.edges.size()]];
    return (n * mesh_.points[v] + 2.0 * sides + opposite(v, i)) / (n + 5.0);
  }

  const PolygonMesh& mesh_;
  MeshTopology topology_;
  std::vector<dvec3> middles_, corners_;
};

/// Along an edge of the face: the boundary and the row next to it.
struct PolygonRows {
  std::array<dvec3, 5> boundary;
  std::array<dvec3, 4> inner;
};

/// `before`, `after`: the face's vertices next to the edge's.
PolygonRows polygonRows(const PolygonMasks& masks, uint32_t face, double share, uint32_t from, uint32_t to,
                        uint32_t before, uint32_t after) {
  const dvec3 first = masks.tangent(from, to), last = -masks.tangent(to, from);
  const dvec3 a = masks.corner(from), d = masks.corner(to), b = a + first / 3.0, c = d - last / 3.0;
  const std::array<dvec3, 3> along = {first, 3.0 * (c - b), last};
  /// Along the edge times a function from `p` to `q`.
  const auto alongTimes = [&](double p, double q) {
    return std::array<dvec3, 4>{p * along[0], (q * along[0] + 2.0 * p * along[1]) / 3.0,
                                (2.0 * q * along[1] + p * along[2]) / 3.0, q * along[2]};
  };
  const double c0 = masks.cosine(from), c1 = masks.cosine(to);
  // Derivatives across are half of what those of both faces sum to, and what differs in sign.
  std::array<dvec3, 4> across = alongTimes(c0, -c1);
  const dvec3 start = masks.tangent(from, before) - across[0], end = masks.tangent(to, after) - across[3];
  across[0] += start, across[3] += end;
  if (masks.areQuads(from, to)) {
    across[1] += 3.0 * masks.besideEdge(face, from, to), across[2] += 3.0 * masks.besideEdge(face, to, from);
  } else {
    across[1] += (2.0 * start + end) / 3.0, across[2] += (start + 2.0 * end) / 3.0;
  }
  // Towards the middle of a regular polygon.
  const std::array<dvec3, 4> skew = alongTimes(share, 1.0 - share);
  PolygonRows out;
  out.boundary = {a, (a + 3.0 * b) / 4.0, (b + c) / 2.0, (3.0 * c + d) / 4.0, d};
  for (size_t i = 0; i < 4; ++i) out.inner[i] = out.boundary[i] + (skew[i] + share * across[i]) / 4.0;
  return out;
}

/// The points of quartic triangles of multi-index (i, j, k) with k >= 2.
struct PolygonInside {
  std::vector<dvec3> second, third, between;  // on the line from vertex k to the middle; of triangle k
  dvec3 middle{0.0};
};

/// First derivatives agree across the lines from vertices to the middle as in a regular polygon: two points
/// beside sum to 2 c times the one before and 2 - 2 c times the next one on the line.
PolygonInside polygonInside(const std::vector<PolygonRows>& edges) {
  const size_t m = edges.size();
  const double c = std::cos(2.0 * std::numbers::pi / double(m)), rest = 2.0 - 2.0 * c;
  PolygonInside out;
  for (size_t k = 0; k < m; ++k)
    out.second.push_back((edges[k].inner[1] + edges[(k + m - 1) % m].inner[2] - 2.0 * c * edges[k].inner[0]) /
                         rest);
  for (size_t k = 0; k < m; ++k) {
    const std::array<dvec3, 4>& row = edges[k].inner;
    const dvec3 bend = 0.5 * ((row[0] - 2.0 * row[1] + row[2]) + (row[1] - 2.0 * row[2] + row[3]));
    out.between.push_back(0.5 * (out.second[k] + out.second[(k + 1) % m] - bend));
  }
  const auto setThird = [&] {
    out.third.clear();
    for (size_t k = 0; k < m; ++k)
      out.third.push_back((out.between[k] + out.between[(k + m - 1) % m] - 2.0 * c * out.second[k]) / rest);
  };
  setThird();
  if (m == 5) {
    // Around the middle, points of a plane that an affine map takes to a regular pentagon's: what turns twice
    // as fast is taken out.
    std::array<dvec3, 5> change;
    for (size_t k = 0; k < m; ++k) {
      dvec3 twice(0.0);
      for (size_t q = 0; q < m; ++q)
        twice += 0.4 * std::cos(4.0 * std::numbers::pi / 5.0 * (double(k) - double(q))) * out.third[q];
      change[k] = -rest * twice;
    }
    for (size_t k = 0; k < m; ++k)
      for (size_t q = 0; q < m; ++q) out.between[k] += (q % 2 == 0 ? 0.5 : -0.5) * change[(k + m - q) % m];
    setThird();
  }
  for (const dvec3& p : out.third) out.middle += p / double(m);
  return out;
}

}  // namespace

PatchSet pmPatches(const PolygonMesh& mesh) {
  const PolygonMasks masks(mesh);
  PatchSet set;
  for (uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const std::vector<uint32_t>& v = mesh.faces[f];
    const size_t m = v.size();
    const double share = 1.0 / (2.0 - 2.0 * std::cos(2.0 * std::numbers::pi / double(m)));
    std::vector<PolygonRows> edges;
    for (size_t k = 0; k < m; ++k)
      edges.push_back(polygonRows(masks, f, share, v[k], v[(k + 1) % m], v[(k + m - 1) % m], v[(k + 2) % m]));
    // Neighbours within the face have the same point on the line between them.
    for (size_t k = 0; k < m; ++k) edges[(k + m - 1) % m].inner[3] = edges[k].inner[0];
    const PolygonInside inside = polygonInside(edges);
    for (size_t k = 0; k < m; ++k) {
      const size_t next = (k + 1) % m;
      const auto& q = edges[k].boundary;
      const auto& p = edges[k].inner;
      // (4 0 0), (3 1 0), (3 0 1), (2 2 0), ...
      const std::array<dvec3, 15> net = {q[0],
                                         q[1],
                                         p[0],
                                         q[2],
                                         p[1],
                                         inside.second[k],
                                         q[3],
                                         p[2],
                                         inside.between[k],
                                         inside.third[k],
                                         q[4],
                                         p[3],
                                         inside.second[next],
                                         inside.third[next],
                                         inside.middle};
      std::array<glm::dvec4, 15> points;
      for (size_t i = 0; i < 15; ++i) points[i] = glm::dvec4(net[i], 1.0);
      addTriangle(set, 4, points);
    }
  }
  findNeighbours(set);
  return set;
}

}  // namespace limen::surfaces
