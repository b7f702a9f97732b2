// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/loop_subdivision.h"

#include <cmath>
#include <optional>
#include <stdexcept>

#include "renderer/surfaces/dart_limit.h"
#include "renderer/surfaces/sharpness_rules.h"

namespace limen::surfaces {
namespace {

/// Weight of each neighbour of a smooth vertex.
double neighbourWeight(size_t valence) {
  const auto k = double(valence);
  const double c = 0.375 + 0.25 * std::cos(2.0 * M_PI / k);
  return (0.625 - c * c) / k;
}

void requireTriangles(const PolygonMesh& mesh) {
  for (const std::vector<uint32_t>& face : mesh.faces)
    if (face.size() != 3) throw std::invalid_argument("Loop's subdivision takes triangles only");
}

uint32_t thirdCorner(const std::vector<uint32_t>& face, EdgeKey edge) {
  for (const uint32_t v : face)
    if (v != edge[0] && v != edge[1]) return v;
  throw std::invalid_argument("a triangle has the same vertex twice");
}

glm::dvec3 vertexByRule(const PolygonMesh& mesh, const VertexRing& ring, uint32_t v,
                        const std::vector<uint32_t>& sharp) {
  const glm::dvec3& p = mesh.points[v];
  if (sharp.size() > 2) return p;
  if (sharp.size() == 2) return 0.75 * p + 0.125 * (mesh.points[sharp[0]] + mesh.points[sharp[1]]);
  glm::dvec3 sum(0.0);
  for (const uint32_t end : ring.edges) sum += mesh.points[end];
  const double beta = neighbourWeight(ring.edges.size());
  return (1.0 - double(ring.edges.size()) * beta) * p + beta * sum;
}

glm::dvec3 edgePoint(const PolygonMesh& mesh, const MeshTopology& topology, EdgeKey edge,
                     const std::array<int32_t, 2>& sides) {
  const glm::dvec3 ends = mesh.points[edge[0]] + mesh.points[edge[1]];
  const double sharp = std::min(1.0, topology.sharpness(mesh, edge));
  if (sharp >= 1.0) return 0.5 * ends;
  glm::dvec3 across(0.0);
  for (const int32_t face : sides)
    across += mesh.points[thirdCorner(mesh.faces[static_cast<size_t>(face)], edge)];
  return (1.0 - sharp) * (0.375 * ends + 0.125 * across) + sharp * 0.5 * ends;
}

/// Across a crease or boundary, into the sector of k faces whose edges are given in order: the left
/// eigenvector of the subdivision matrix for 3/8 + cos(pi / k) / 4. It is sin(i pi / k) at inner edge i; the
/// crease's ends and the vertex follow from the eigenvalue's equations. One face: the curve's bend.
glm::dvec3 acrossCrease(glm::dvec3 p, const std::vector<glm::dvec3>& edges) {
  const size_t k = edges.size() - 1;
  const glm::dvec3 ends = edges.front() + edges.back();
  if (k == 1) return ends - 2.0 * p;
  const double turn = M_PI / double(k), lambda = 0.375 + 0.25 * std::cos(turn);
  glm::dvec3 out(0.0);
  double sines = 0.0;
  for (size_t i = 1; i < k; ++i) {
    out += std::sin(turn * double(i)) * edges[i];
    sines += std::sin(turn * double(i));
  }
  // Shares: of a crease's end, 1/2 in itself, 1/8 in the edge beside it and in the vertex; of the vertex, 3/4
  // in itself, 1/2 in either end and 3/8 in inner edges.
  const double ofVertex =
      (0.125 * std::sin(turn) + (lambda - 0.5) * 0.375 * sines) / ((lambda - 0.5) * (lambda - 0.75) - 0.125);
  const double ofEnds = (lambda - 0.75) * ofVertex - 0.375 * sines;
  return out + ofVertex * p + ofEnds * ends;
}

glm::dvec3 smoothNormal(const std::vector<glm::dvec3>& edges) {
  glm::dvec3 x(0.0), y(0.0);
  for (size_t i = 0; i < edges.size(); ++i) {
    const double at = 2.0 * M_PI * double(i) / double(edges.size());
    x += std::cos(at) * edges[i], y += std::sin(at) * edges[i];
  }
  return glm::cross(x, y);
}

}  // namespace

PolygonMesh loop(const PolygonMesh& mesh, Fans fans) {
  requireTriangles(mesh);
  const MeshTopology topology(mesh, fans);
  PolygonMesh out;
  for (uint32_t v = 0; v < mesh.points.size(); ++v)
    out.points.push_back(refinedVertex(mesh, topology, v, [&](const std::vector<uint32_t>& sharp) {
      return vertexByRule(mesh, topology.rings()[v], v, sharp);
    }));
  std::map<EdgeKey, uint32_t> edgeIndex;
  for (const auto& [edge, sides] : topology.edges()) {
    const auto index = static_cast<uint32_t>(out.points.size());
    edgeIndex[edge] = index;
    out.points.push_back(edgePoint(mesh, topology, edge, sides));
    const auto given = mesh.sharpness.find(edge);
    if (given == mesh.sharpness.end()) continue;
    if (const double s = nextSharpness(given->second); s > 0.0)
      out.sharpness[edgeKey(edge[0], index)] = out.sharpness[edgeKey(edge[1], index)] = s;
  }
  for (const std::vector<uint32_t>& face : mesh.faces) {
    std::array<uint32_t, 3> after{};
    for (size_t i = 0; i < 3; ++i) after[i] = edgeIndex.at(edgeKey(face[i], face[(i + 1) % 3]));
    for (size_t i = 0; i < 3; ++i) out.faces.push_back({face[i], after[i], after[(i + 2) % 3]});
    out.faces.push_back({after[0], after[1], after[2]});
  }
  return out;
}

PolygonMesh loop(PolygonMesh mesh, int steps) {
  for (int i = 0; i < steps; ++i) mesh = loop(mesh);
  return mesh;
}

LoopLimit loopLimit(const PolygonMesh& mesh, Fans fans) {
  requireTriangles(mesh);
  for (const auto& [edge, s] : mesh.sharpness)
    if (s > 0.0 && s < kInfinitelySharp) throw std::invalid_argument("an edge is neither smooth nor sharp");
  const MeshTopology topology(mesh, fans);
  LoopLimit out;
  out.normals.resize(mesh.faces.size());
  for (uint32_t v = 0; v < mesh.points.size(); ++v) {
    const VertexRing& ring = topology.rings()[v];
    const glm::dvec3& p = mesh.points[v];
    out.points.push_back(p);
    if (ring.faces.empty()) continue;
    const std::vector<uint32_t> sharp = sharpEnds(mesh, topology, v);
    const bool smooth = sharp.size() < 2;
    const bool corner = sharp.size() > 2 || (!ring.closed && ring.faces.size() == 1);
    std::optional<DartLimit> dart;
    if (sharp.size() == 1) {
      std::vector<glm::dvec3> ends;
      for (const uint32_t end : ring.edges) ends.push_back(mesh.points[end]);
      const auto place = std::find(ring.edges.begin(), ring.edges.end(), sharp[0]) - ring.edges.begin();
      dart = loopDart(p, ends, neighbourWeight(ends.size()), static_cast<size_t>(place));
      out.points[v] = dart->point;
    } else if (smooth) {
      glm::dvec3 sum(0.0);
      for (const uint32_t end : ring.edges) sum += mesh.points[end];
      const double own = 0.375 / neighbourWeight(ring.edges.size());
      out.points[v] = (own * p + sum) / (own + double(ring.edges.size()));
    } else if (!corner) {
      out.points[v] = (4.0 * p + mesh.points[sharp[0]] + mesh.points[sharp[1]]) / 6.0;
    }
    for (const std::vector<size_t>& sector : sectorsOf(ring, sharp)) {
      std::vector<glm::dvec3> edges;
      for (const size_t place : sector) edges.push_back(mesh.points[ring.edges[place]]);
      if (!smooth) edges.push_back(mesh.points[ring.edges[(sector.back() + 1) % ring.edges.size()]]);
      const glm::dvec3 across = dart     ? dart->normal
                                : smooth ? smoothNormal(edges)
                                : corner ? glm::cross(edges.front() - p, edges.back() - p)
                                         : glm::cross(edges.front() - edges.back(), acrossCrease(p, edges));
      const double length = glm::length(across);
      const glm::dvec3 normal = length > 0.0 ? across / length : glm::dvec3(0.0, 0.0, 1.0);
      for (const size_t place : sector) {
        const std::vector<uint32_t>& face = mesh.faces[ring.faces[place]];
        const auto c = std::find(face.begin(), face.end(), v) - face.begin();
        out.normals[ring.faces[place]][static_cast<size_t>(c)] = normal;
      }
    }
  }
  return out;
}

}  // namespace limen::surfaces
