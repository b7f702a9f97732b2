// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/c_patches.h"

#include "renderer/surfaces/acc_masks.h"
#include "renderer/surfaces/acc_patches.h"
#include "renderer/surfaces/bezier.h"
#include "renderer/surfaces/neighbours.h"
#include "renderer/surfaces/patch_builder.h"

namespace limen::surfaces {
namespace {

using glm::dvec3;

/// Along an edge of the quad: the boundary and the row next to it.
struct EdgeRows {
  std::array<dvec3, 5> boundary;
  std::array<dvec3, 4> inner;
};

/// `own`: ACC's inner points of the quad next to `from` and `to`; `fromSide`, `toSide`: the vertices next to
/// them across the edge.
EdgeRows edgeRows(const AccMasks& masks, uint32_t from, uint32_t to, uint32_t fromSide, uint32_t toSide,
                  dvec3 ownFrom, dvec3 ownTo) {
  const dvec3 first = masks.tangent(from, to), last = -masks.tangent(to, from);
  const dvec3 a = masks.corner(from), d = masks.corner(to), b = a + first / 3.0, c = d - last / 3.0;
  const dvec3 middle = 3.0 * (c - b);
  // With the neighbour's, tangents across sum to a multiple of that along the edge, linear along it.
  const bool sharp = masks.isSharp(from, to);
  const double c0 = sharp ? 0.0 : masks.cosine(from, to), c1 = sharp ? 0.0 : masks.cosine(to, from);
  const std::array<dvec3, 4> across = {
      masks.tangent(from, fromSide),
      (2.0 * c0 * middle - c1 * first) / 3.0 + 3.0 * (ownFrom - masks.edge(from, to)),
      (c0 * last - 2.0 * c1 * middle) / 3.0 + 3.0 * (ownTo - masks.edge(to, from)),
      masks.tangent(to, toSide)};
  EdgeRows out;
  out.boundary = {a, (a + 3.0 * b) / 4.0, (b + c) / 2.0, (3.0 * c + d) / 4.0, d};
  // The middle of the quad lies half a unit across: a quartic's derivative is four times the difference.
  for (size_t i = 0; i < 4; ++i)
    out.inner[i] = 0.5 * (out.boundary[i] + out.boundary[i + 1]) + across[i] / 8.0;
  return out;
}

/// The points of a quartic triangle of multi-index (i, j, k) with k >= 2, of the four triangles.
struct Inside {
  std::array<dvec3, 4> second, third, between;  // on the diagonal from vertex k; of triangle k
  dvec3 middle{0.0};
};

double quartic(int i, int j, int k, double a, double b, double m) {
  double out = 24.0;
  for (const auto& [n, t] : {std::pair(i, a), {j, b}, {k, m}})
    for (int q = 1; q <= n; ++q) out *= t / q;
  return out;
}

/// First derivatives agree across the diagonals if two points beside them sum to twice the next one on them.
/// What is left, `between`, makes triangle k go through `through[k]` half way from its edge's middle to the
/// quad's.
Inside insideOf(const std::array<EdgeRows, 4>& edges, const std::array<dvec3, 4>& through) {
  Inside out;
  out.between.fill(dvec3(0.0));
  for (size_t k = 0; k < 4; ++k) out.second[k] = 0.5 * (edges[k].inner[1] + edges[(k + 3) % 4].inner[2]);
  const auto weight = [](int i, int j, int n) { return quartic(i, j, n, 0.25, 0.25, 0.5); };
  glm::dmat4 system(0.0);
  std::array<dvec3, 4> rest = through;
  for (size_t k = 0; k < 4; ++k) {
    const size_t next = (k + 1) % 4;
    for (int q = 0; q <= 4; ++q) rest[k] -= weight(4 - q, q, 0) * edges[k].boundary[static_cast<size_t>(q)];
    for (int q = 0; q <= 3; ++q) rest[k] -= weight(3 - q, q, 1) * edges[k].inner[static_cast<size_t>(q)];
    rest[k] -= weight(2, 0, 2) * out.second[k] + weight(0, 2, 2) * out.second[next];
    const auto add = [&](size_t of, double share) {
      system[static_cast<int>(of)][static_cast<int>(k)] += share;
    };
    add(k, weight(1, 1, 2));
    // third[k] is the mean of between[k] and between[k - 1].
    for (const auto& [at, share] : {std::pair(k, weight(1, 0, 3)), {next, weight(0, 1, 3)}})
      add(at, 0.5 * share), add((at + 3) % 4, 0.5 * share);
    for (size_t of = 0; of < 4; ++of) add(of, 0.25 * weight(0, 0, 4));
  }
  const glm::dmat4 solution = glm::inverse(system);
  for (size_t k = 0; k < 4; ++k)
    for (size_t of = 0; of < 4; ++of)
      out.between[k] += solution[static_cast<int>(of)][static_cast<int>(k)] * rest[of];
  for (size_t k = 0; k < 4; ++k) {
    out.third[k] = 0.5 * (out.between[k] + out.between[(k + 3) % 4]);
    out.middle += 0.25 * out.between[k];
  }
  return out;
}

}  // namespace

PatchSet cPatches(const PolygonMesh& mesh) {
  const AccMasks masks(mesh);
  const PatchSet bicubic = accPatches(mesh);
  PatchSet set;
  for (uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const std::vector<uint32_t>& v = mesh.faces[f];
    std::array<EdgeRows, 4> edges;
    std::array<dvec3, 4> through;
    const std::array<glm::dvec2, 4> places = {{{0.5, 0.25}, {0.75, 0.5}, {0.5, 0.75}, {0.25, 0.5}}};
    for (size_t k = 0; k < 4; ++k) {
      edges[k] = edgeRows(masks, v[k], v[(k + 1) % 4], v[(k + 3) % 4], v[(k + 2) % 4], masks.inner(f, k),
                          masks.inner(f, (k + 1) % 4));
      through[k] =
          evaluate(bicubic, bicubic.patches[f], rectanglePoint(places[k].x, places[k].y), Order::Position).p;
    }
    const Inside inside = insideOf(edges, through);
    for (size_t k = 0; k < 4; ++k) {
      const size_t next = (k + 1) % 4;
      const auto& q = edges[k].boundary;
      const auto& p = edges[k].inner;
      // (4 0 0), (3 1 0), (3 0 1), (2 2 0), ...
      // Points on diagonals belong to two triangles: of `inner` the one that the diagonal's vertex begins.
      const dvec3 ownDiagonal = p[0], nextDiagonal = edges[next].inner[0];
      const std::array<dvec3, 15> net = {q[0],
                                         q[1],
                                         ownDiagonal,
                                         q[2],
                                         p[1],
                                         inside.second[k],
                                         q[3],
                                         p[2],
                                         inside.between[k],
                                         inside.third[k],
                                         q[4],
                                         nextDiagonal,
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
