// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/subdivision_stencils.h"

#include <algorithm>
#include <cmath>

#include "experiments/base/error.h"

namespace limen::surfaces {
namespace {

class StencilSum {
 public:
  void add(uint32_t vertex, double weight) { weights_[vertex] += weight; }
  Stencil take() const { return {weights_.begin(), weights_.end()}; }

 private:
  std::map<uint32_t, double> weights_;
};

std::vector<uint32_t> sharpNeighbours(const RuleMesh& mesh, const HalfEdges::Ring& ring, uint32_t v) {
  std::vector<uint32_t> out;
  for (const uint32_t end : ring.ends)
    if (mesh.isSharp(v, end)) out.push_back(end);
  return out;
}

/// Of a piece's vertex the fan may have been cut in two; all its sharp neighbours count.
std::vector<uint32_t> sharpNeighbours(const RuleMesh& mesh, uint32_t v) {
  std::vector<uint32_t> out;
  for (const EdgeKey& edge : mesh.sharp)
    if (edge[0] == v || edge[1] == v) out.push_back(edge[0] == v ? edge[1] : edge[0]);
  return out;
}

Stencil mixed(uint32_t v, double own, const std::vector<uint32_t>& others, double each) {
  StencilSum sum;
  sum.add(v, own);
  for (const uint32_t other : others) sum.add(other, each);
  return sum.take();
}

double loopBeta(size_t valence) {
  const double n = double(valence), c = 0.375 + 0.25 * std::cos(2.0 * M_PI / n);
  return (0.625 - c * c) / n;
}

/// Vertices of the faces around a smooth vertex other than itself and its neighbours, each 1 / size of its
/// face, and the face points' shares of all: the sum of the face points around it.
void addFacePoints(StencilSum& sum, const RuleMesh& mesh, const HalfEdges& edges, uint32_t v, double each) {
  uint32_t h = edges.outgoing[v];
  do {
    const std::vector<uint32_t>& face = mesh.faces[edges.face[h]];
    for (const uint32_t corner : face) sum.add(corner, each / double(face.size()));
    h = edges.turned(h);
  } while (h != edges.outgoing[v]);
}

std::optional<Stencil> smoothVertex(const RuleMesh& mesh, const HalfEdges& edges, SubdivisionScheme scheme,
                                    uint32_t v, const HalfEdges::Ring& ring) {
  const double n = double(ring.ends.size());
  if (scheme == SubdivisionScheme::Loop) {
    const double beta = loopBeta(ring.ends.size());
    return mixed(v, 1.0 - n * beta, ring.ends, beta);
  }
  // (face points' mean + 2 edge middles' mean + (n - 3) v) / n.
  StencilSum sum;
  sum.add(v, (n - 3.0) / n + 1.0 / n);
  for (const uint32_t end : ring.ends) sum.add(end, 1.0 / (n * n));
  addFacePoints(sum, mesh, edges, v, 1.0 / (n * n));
  return sum.take();
}

void addScaled(StencilSum& sum, const Stencil& stencil, double scale) {
  for (const auto& [vertex, weight] : stencil) sum.add(vertex, scale * weight);
}

/// A vertex some of whose edges are semi-sharp: the rule of the edges that are sharp now, blended with that
/// of those that still are after the step where some lose their sharpness on the way.
std::optional<Stencil> semiSharpVertex(const RuleMesh& mesh, const HalfEdges& edges, SubdivisionScheme scheme,
                                       uint32_t v, const HalfEdges::Ring& ring) {
  std::vector<uint32_t> now, next;
  double lost = 0.0;
  for (const uint32_t end : ring.ends) {
    const auto given = mesh.semiSharp.find(edgeKey(v, end));
    const bool semi = given != mesh.semiSharp.end();
    if (!semi && !mesh.isSharp(v, end)) continue;
    now.push_back(end);
    if (semi && given->second <= 1.0)
      lost += given->second;
    else
      next.push_back(end);
  }
  const auto rule = [&](const std::vector<uint32_t>& sharp) {
    if (sharp.size() > 2) return Stencil{{v, 1.0}};
    if (sharp.size() == 2) return mixed(v, 0.75, sharp, 0.125);
    return *smoothVertex(mesh, edges, scheme, v, ring);
  };
  const double share =
      now.size() == next.size() ? 1.0 : std::min(1.0, lost / double(now.size() - next.size()));
  StencilSum sum;
  addScaled(sum, rule(now), share);
  if (share < 1.0) addScaled(sum, rule(next), 1.0 - share);
  return sum.take();
}

std::optional<Stencil> vertexRule(const RuleMesh& mesh, const HalfEdges& edges, SubdivisionScheme scheme,
                                  uint32_t v) {
  if (scheme == SubdivisionScheme::Butterfly || mesh.corners.contains(v)) return Stencil{{v, 1.0}};
  if (edges.outgoing[v] == HalfEdges::kNone) return Stencil{{v, 1.0}};
  const HalfEdges::Ring ring = edges.ring(v);
  if (!mesh.semiSharp.empty()) return semiSharpVertex(mesh, edges, scheme, v, ring);
  std::vector<uint32_t> sharp = sharpNeighbours(mesh, ring, v);
  if (!ring.closed && sharp.size() < 2) sharp = sharpNeighbours(mesh, v);
  if (sharp.size() == 2) return mixed(v, 0.75, sharp, 0.125);
  if (!ring.closed || sharp.size() > 2) return std::nullopt;
  return smoothVertex(mesh, edges, scheme, v, ring);
}

std::optional<uint32_t> across(const HalfEdges& edges, uint32_t h) {
  if (h == HalfEdges::kNone) return std::nullopt;
  return edges.from[edges.previous[h]];
}

/// Around an extraordinary end: weights by the number of edges from the one that is divided.
double butterflyWeight(size_t valence, size_t j) {
  const double k = double(valence), turn = 2.0 * M_PI * double(j) / k;
  if (valence == 3) return j == 0 ? 5.0 / 12.0 : -1.0 / 12.0;
  if (valence == 4) return j == 0 ? 0.375 : j == 2 ? -0.125 : 0.0;
  return (0.25 + std::cos(turn) + 0.5 * std::cos(2.0 * turn)) / k;
}

void addButterflyEnd(StencilSum& sum, uint32_t v, const HalfEdges::Ring& ring, uint32_t other, double share) {
  const size_t k = ring.ends.size();
  const auto first =
      static_cast<size_t>(std::find(ring.ends.begin(), ring.ends.end(), other) - ring.ends.begin());
  sum.add(v, 0.75 * share);
  for (size_t j = 0; j < k; ++j) sum.add(ring.ends[(first + j) % k], butterflyWeight(k, j) * share);
}

std::optional<Stencil> butterflyEdge(const HalfEdges& edges, uint32_t h) {
  const uint32_t a = edges.from[h], b = edges.to(h);
  const HalfEdges::Ring atA = edges.ring(a), atB = edges.ring(b);
  if (!atA.closed || !atB.closed) return std::nullopt;
  const bool plainA = atA.ends.size() == 6, plainB = atB.ends.size() == 6;
  StencilSum sum;
  if (!plainA || !plainB) {
    const double share = !plainA && !plainB ? 0.5 : 1.0;
    if (!plainA) addButterflyEnd(sum, a, atA, b, share);
    if (!plainB) addButterflyEnd(sum, b, atB, a, share);
    return sum.take();
  }
  sum.add(a, 0.5), sum.add(b, 0.5);
  for (const uint32_t side : {h, edges.twin[h]}) {
    sum.add(*across(edges, side), 0.125);
    for (const uint32_t beside : {edges.next[side], edges.previous[side]}) {
      const auto wing = across(edges, edges.twin[beside]);
      if (!wing) return std::nullopt;
      sum.add(*wing, -1.0 / 16.0);
    }
  }
  return sum.take();
}

std::optional<Stencil> smoothOrSharpEdge(const RuleMesh& mesh, const HalfEdges& edges,
                                         SubdivisionScheme scheme, uint32_t h) {
  const uint32_t a = edges.from[h], b = edges.to(h);
  StencilSum sum;
  if (mesh.isSharp(a, b)) {
    sum.add(a, 0.5), sum.add(b, 0.5);
    return sum.take();
  }
  if (edges.twin[h] == HalfEdges::kNone) return std::nullopt;
  if (scheme == SubdivisionScheme::Butterfly) return butterflyEdge(edges, h);
  if (scheme == SubdivisionScheme::Loop) {
    sum.add(a, 0.375), sum.add(b, 0.375);
    sum.add(*across(edges, h), 0.125), sum.add(*across(edges, edges.twin[h]), 0.125);
    return sum.take();
  }
  sum.add(a, 0.25), sum.add(b, 0.25);
  for (const uint32_t side : {h, edges.twin[h]}) {
    const std::vector<uint32_t>& face = mesh.faces[edges.face[side]];
    for (const uint32_t corner : face) sum.add(corner, 0.25 / double(face.size()));
  }
  return sum.take();
}

std::optional<Stencil> edgeRule(const RuleMesh& mesh, const HalfEdges& edges, SubdivisionScheme scheme,
                                uint32_t h) {
  std::optional<Stencil> rule = smoothOrSharpEdge(mesh, edges, scheme, h);
  const EdgeKey edge = edgeKey(edges.from[h], edges.to(h));
  const auto given = mesh.semiSharp.find(edge);
  if (!rule || given == mesh.semiSharp.end()) return rule;
  const double share = std::min(1.0, given->second);
  StencilSum sum;
  addScaled(sum, *rule, 1.0 - share);
  addScaled(sum, {{edge[0], 0.5}, {edge[1], 0.5}}, share);
  return sum.take();
}

}  // namespace

int stepsUntilSmooth(const PolygonMesh& mesh) {
  double most = 0.0;
  for (const auto& [edge, s] : mesh.sharpness)
    if (s < kInfinitelySharp) most = std::max(most, s);
  return static_cast<int>(std::ceil(most));
}

RuleMesh ruleMesh(const PolygonMesh& mesh, SubdivisionScheme scheme) {
  if (const auto fault = findFault(mesh.points.size(), mesh.faces))
    throw Error("the control mesh is no manifold: " + fault->what, "", "mend the mesh");
  RuleMesh out{mesh.points.size(), mesh.faces, {}, {}, {}};
  std::map<EdgeKey, int> sides;
  std::vector<uint32_t> facesAt(out.vertices), sharpAt(out.vertices);
  for (const std::vector<uint32_t>& face : mesh.faces) {
    if (scheme != SubdivisionScheme::CatmullClark && face.size() != 3)
      throw Error("a face has " + std::to_string(face.size()) + " vertices", "",
                  "this scheme takes triangles");
    for (size_t i = 0; i < face.size(); ++i) {
      ++sides[edgeKey(face[i], face[(i + 1) % face.size()])];
      ++facesAt[face[i]];
    }
  }
  std::set<uint32_t> atBoundary;
  for (const auto& [edge, count] : sides) {
    const auto given = mesh.sharpness.find(edge);
    const double s = given == mesh.sharpness.end() ? 0.0 : given->second;
    if (count == 2 && s > 0.0 && s < kInfinitelySharp) out.semiSharp[edge] = s;
    if (count == 2 && s < kInfinitelySharp) continue;
    out.sharp.insert(edge);
    for (const uint32_t end : edge) {
      ++sharpAt[end];
      if (count == 1) atBoundary.insert(end);
    }
  }
  if (scheme == SubdivisionScheme::Butterfly && !(out.sharp.empty() && out.semiSharp.empty()))
    throw Error("the mesh has boundaries or sharp edges", "",
                "the Butterfly scheme here takes closed, smooth meshes");
  for (uint32_t v = 0; v < out.vertices; ++v)
    if (sharpAt[v] > 2 || (atBoundary.contains(v) && facesAt[v] == 1)) out.corners.insert(v);
  return out;
}

SubdivisionStep refined(const RuleMesh& mesh, SubdivisionScheme scheme) {
  const HalfEdges edges(mesh.vertices, mesh.faces);
  SubdivisionStep out;
  for (uint32_t v = 0; v < mesh.vertices; ++v) out.points.push_back(vertexRule(mesh, edges, scheme, v));
  out.mesh.corners = mesh.corners;
  const bool quads = scheme == SubdivisionScheme::CatmullClark;
  out.firstFacePoint = static_cast<uint32_t>(mesh.vertices);
  if (quads)
    for (const std::vector<uint32_t>& face : mesh.faces) {
      StencilSum sum;
      for (const uint32_t v : face) sum.add(v, 1.0 / double(face.size()));
      out.points.emplace_back(sum.take());
    }
  std::map<EdgeKey, uint32_t> anyHalf;
  for (uint32_t h = 0; h < edges.from.size(); ++h) anyHalf.emplace(edgeKey(edges.from[h], edges.to(h)), h);
  for (const auto& [edge, h] : anyHalf) {
    const auto index = static_cast<uint32_t>(out.points.size());
    out.edgePoints[edge] = index;
    out.points.push_back(edgeRule(mesh, edges, scheme, h));
    if (mesh.sharp.contains(edge)) out.mesh.sharp.insert({edgeKey(edge[0], index), edgeKey(edge[1], index)});
    const auto semi = mesh.semiSharp.find(edge);
    if (semi != mesh.semiSharp.end() && semi->second > 1.0)
      out.mesh.semiSharp[edgeKey(edge[0], index)] = out.mesh.semiSharp[edgeKey(edge[1], index)] =
          semi->second - 1.0;
  }
  for (uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const std::vector<uint32_t>& face = mesh.faces[f];
    const size_t k = face.size();
    std::vector<uint32_t> after(k);
    for (size_t i = 0; i < k; ++i) after[i] = out.edgePoints.at(edgeKey(face[i], face[(i + 1) % k]));
    for (size_t i = 0; i < k; ++i) {
      const uint32_t before = after[(i + k - 1) % k];
      if (quads)
        out.mesh.faces.push_back({face[i], after[i], out.firstFacePoint + f, before});
      else
        out.mesh.faces.push_back({face[i], after[i], before});
    }
    if (!quads) out.mesh.faces.push_back({after[0], after[1], after[2]});
  }
  out.mesh.vertices = out.points.size();
  return out;
}

std::optional<Stencil> limitStencil(const RuleMesh& mesh, const HalfEdges& edges, SubdivisionScheme scheme,
                                    uint32_t v) {
  if (scheme == SubdivisionScheme::Butterfly || mesh.corners.contains(v) ||
      edges.outgoing[v] == HalfEdges::kNone)
    return Stencil{{v, 1.0}};
  const HalfEdges::Ring ring = edges.ring(v);
  std::vector<uint32_t> sharp = sharpNeighbours(mesh, ring, v);
  if (!ring.closed && sharp.size() < 2) sharp = sharpNeighbours(mesh, v);
  if (sharp.size() == 2) return mixed(v, 2.0 / 3.0, sharp, 1.0 / 6.0);
  if (!ring.closed || sharp.size() > 2) return std::nullopt;
  const double n = double(ring.ends.size());
  if (scheme == SubdivisionScheme::Loop) {
    const double x = 1.0 / (n + 0.375 / loopBeta(ring.ends.size()));
    return mixed(v, 1.0 - n * x, ring.ends, x);
  }
  // n^2 v + 4 neighbours + vertices across the quads, over n (n + 5).
  StencilSum sum;
  const double each = 1.0 / (n * (n + 5.0));
  sum.add(v, n * n * each);
  for (const uint32_t end : ring.ends) sum.add(end, 4.0 * each);
  uint32_t h = edges.outgoing[v];
  do {
    sum.add(edges.from[edges.next[edges.next[h]]], each);
    h = edges.turned(h);
  } while (h != edges.outgoing[v]);
  return sum.take();
}

std::optional<std::array<Stencil, 2>> loopTangents(const RuleMesh& mesh, const HalfEdges& edges, uint32_t v) {
  const HalfEdges::Ring ring = edges.ring(v);
  std::vector<uint32_t> ends = ring.ends;
  StencilSum along, over;
  if (ring.closed && sharpNeighbours(mesh, ring, v).size() < 2) {
    for (size_t i = 0; i < ends.size(); ++i) {
      const double turn = 2.0 * M_PI * double(i) / double(ends.size());
      along.add(ends[i], std::cos(turn));
      over.add(ends[i], std::sin(turn));
    }
    return {{along.take(), over.take()}};
  }
  if (ring.closed || !mesh.isSharp(v, ends.front()) || !mesh.isSharp(v, ends.back())) return std::nullopt;
  const size_t m = ends.size() - 1;
  if (mesh.corners.contains(v)) {
    if (m > 1) return std::nullopt;
    along.add(ends[0], 1.0), along.add(v, -1.0);
    over.add(ends[1], 1.0), over.add(v, -1.0);
    return {{along.take(), over.take()}};
  }
  along.add(ends.front(), 1.0), along.add(ends.back(), -1.0);
  if (m == 1) {
    over.add(ends[0], 1.0), over.add(ends[1], 1.0), over.add(v, -2.0);
    return {{along.take(), over.take()}};
  }
  // The left eigenvector of the rules around v for the eigenvalue 3/8 + cos(pi / m) / 4: sin(i pi / m) at
  // inner edge i; those of v and of the ends solve the eigenvalue's two equations (with the masks of v and of
  // boundary edges). The weights of Zorin and Schroeder 2000 are for other rules at boundaries.
  const double turn = M_PI / double(m), lambda = 0.375 + 0.25 * std::cos(turn);
  double sines = 0.0;
  for (size_t i = 1; i < m; ++i) {
    over.add(ends[i], std::sin(turn * double(i)));
    sines += std::sin(turn * double(i));
  }
  const double own =
      (0.125 * std::sin(turn) + 0.375 * (lambda - 0.5) * sines) / ((lambda - 0.5) * (lambda - 0.75) - 0.125);
  over.add(v, own);
  for (const uint32_t end : {ends.front(), ends.back()}) over.add(end, (lambda - 0.75) * own - 0.375 * sines);
  return {{along.take(), over.take()}};
}

}  // namespace limen::surfaces
