// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/catmull_clark.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "renderer/surfaces/dart_limit.h"
#include "renderer/surfaces/sharpness_rules.h"

namespace limen::surfaces {
namespace {

class Step {
 public:
  Step(const PolygonMesh& mesh, Fans fans) : mesh_(mesh), topology_(mesh, fans) {
    for (const std::vector<uint32_t>& face : mesh.faces) {
      glm::dvec3 sum(0.0);
      for (const uint32_t vertex : face) sum += mesh.points[vertex];
      facePoints_.push_back(sum / double(face.size()));
    }
  }

  PolygonMesh result() const {
    PolygonMesh out;
    for (uint32_t v = 0; v < mesh_.points.size(); ++v) out.points.push_back(vertexPoint(v));
    const auto firstFace = static_cast<uint32_t>(out.points.size());
    out.points.insert(out.points.end(), facePoints_.begin(), facePoints_.end());
    std::map<EdgeKey, uint32_t> edgeIndex;
    for (const auto& [edge, sides] : topology_.edges()) {
      const auto index = static_cast<uint32_t>(out.points.size());
      edgeIndex[edge] = index;
      out.points.push_back(edgePoint(edge, sides));
      const auto given = mesh_.sharpness.find(edge);
      if (given == mesh_.sharpness.end()) continue;
      if (const double s = nextSharpness(given->second); s > 0.0)
        out.sharpness[edgeKey(edge[0], index)] = out.sharpness[edgeKey(edge[1], index)] = s;
    }
    for (uint32_t f = 0; f < mesh_.faces.size(); ++f) {
      const std::vector<uint32_t>& face = mesh_.faces[f];
      for (size_t i = 0; i < face.size(); ++i) {
        const uint32_t at = face[i], next = face[(i + 1) % face.size()],
                       previous = face[(i + face.size() - 1) % face.size()];
        out.faces.push_back(
            {at, edgeIndex.at(edgeKey(at, next)), firstFace + f, edgeIndex.at(edgeKey(previous, at))});
      }
    }
    return out;
  }

 private:
  glm::dvec3 edgePoint(EdgeKey edge, const std::array<int32_t, 2>& sides) const {
    const glm::dvec3 middle = 0.5 * (mesh_.points[edge[0]] + mesh_.points[edge[1]]);
    const double sharp = std::min(1.0, topology_.sharpness(mesh_, edge));
    if (sharp >= 1.0) return middle;
    const glm::dvec3 faces =
        facePoints_[static_cast<size_t>(sides[0])] + facePoints_[static_cast<size_t>(sides[1])];
    return (1.0 - sharp) * (0.5 * middle + 0.25 * faces) + sharp * middle;
  }

  glm::dvec3 smoothPoint(uint32_t v) const {
    const VertexRing& ring = topology_.rings()[v];
    const auto k = double(ring.faces.size());
    glm::dvec3 sum(0.0);
    for (const uint32_t end : ring.edges) sum += mesh_.points[end];
    for (const uint32_t face : ring.faces) sum += facePoints_[face];
    return (k - 2.0) / k * mesh_.points[v] + sum / (k * k);
  }

  glm::dvec3 byRule(uint32_t v, const std::vector<uint32_t>& sharp) const {
    if (sharp.size() > 2) return mesh_.points[v];
    if (sharp.size() < 2) return smoothPoint(v);
    return 0.75 * mesh_.points[v] + 0.125 * (mesh_.points[sharp[0]] + mesh_.points[sharp[1]]);
  }

  glm::dvec3 vertexPoint(uint32_t v) const {
    return refinedVertex(mesh_, topology_, v,
                         [&](const std::vector<uint32_t>& sharp) { return byRule(v, sharp); });
  }

  const PolygonMesh& mesh_;
  MeshTopology topology_;
  std::vector<glm::dvec3> facePoints_;
};

/// The part of a ring between two sharp edges or, closed, all of it: quads' far corners lie between edges.
struct Sector {
  std::vector<glm::dvec3> edges, diagonals;  ///< positions; closed: as many edges as diagonals
  std::vector<size_t> faces;                 ///< places in the ring
};

glm::dvec3 farCorner(const PolygonMesh& mesh, uint32_t face, uint32_t vertex) {
  const std::vector<uint32_t>& corners = mesh.faces[face];
  const auto at = std::find(corners.begin(), corners.end(), vertex) - corners.begin();
  return mesh.points[corners[static_cast<size_t>(at + 2) % 4]];
}

/// Tangents of Halstead, Kass and DeRose (1993), SIGGRAPH, appendix A.
glm::dvec3 smoothNormal(const Sector& all) {
  const size_t n = all.edges.size();
  const double turn = 2.0 * M_PI / double(n), c = std::cos(turn);
  const double a = 1.0 + c + std::cos(0.5 * turn) * std::sqrt(2.0 * (9.0 + c));
  glm::dvec3 x(0.0), y(0.0);
  for (size_t i = 0; i < n; ++i) {
    const double at = turn * double(i), then = turn * double(i + 1);
    x += a * std::cos(at) * all.edges[i] + (std::cos(at) + std::cos(then)) * all.diagonals[i];
    y += a * std::sin(at) * all.edges[i] + (std::sin(at) + std::sin(then)) * all.diagonals[i];
  }
  return glm::cross(x, y);
}

/// Weights of the derivative across a crease or boundary with k >= 3 faces on this side: the left eigenvector
/// of the subdivision matrix for its largest eigenvalue below 1. The inner edges and diagonals are those of
/// a smooth vertex of valence 2 k; the two crease edges and the vertex follow from the eigenvalue's
/// equations. (For k >= 5 the second eigenvector is not the crease's tangent, and the rules of DeRose et al.
/// leave a surface that is not C1 there, see Biermann, Levin and Zorin 2000; the normal is then that of the
/// plane through the crease.)
struct CreaseWeights {
  double vertex, crease, edge, diagonal;  ///< edge i: edge sin(i turn); diagonal: both its edges' sines
};
CreaseWeights creaseWeights(size_t k) {
  const double turn = M_PI / double(k), c = std::cos(turn);
  const double lambda = (5.0 + c + std::sqrt((c + 9.0) * (c + 1.0))) / 16.0;
  CreaseWeights out{0.0, 0.0, 1.0 + c + std::cos(0.5 * turn) * std::sqrt(2.0 * (9.0 + c)), 1.0};
  double sines = 0.0;
  for (size_t i = 1; i < k; ++i) sines += std::sin(turn * double(i));
  // Shares of the vertex: 3/8 in an inner edge, 1/4 in a face; of a crease edge: 1/16 in the edge beside it,
  // 1/4 in the face.
  const double ofVertex = 0.375 * out.edge * sines + 0.25 * out.diagonal * 2.0 * sines;
  const double ofCrease = (out.edge / 16.0 + 0.25 * out.diagonal) * std::sin(turn);
  const double determinant = (lambda - 0.75) * (lambda - 0.5) - 0.125;
  out.vertex = ((lambda - 0.5) * ofVertex + ofCrease) / determinant;
  out.crease = (0.125 * out.vertex + ofCrease) / (lambda - 0.5);
  return out;
}

/// Across the crease or boundary, into the sector.
glm::dvec3 acrossCrease(glm::dvec3 vertex, const Sector& sector) {
  const size_t k = sector.diagonals.size();
  const glm::dvec3 first = sector.edges.front(), last = sector.edges.back(), ends = first + last;
  if (k == 1) {
    // The eigenvalue across is 1/4 with a Jordan block, which the bend of the crease decides if it has one.
    const glm::dvec3 bend = ends - 2.0 * vertex;
    return glm::length(bend) < 1e-9 * glm::length(first - last) ? sector.diagonals[0] - vertex : bend;
  }
  // The B-spline's cross derivative.
  if (k == 2) return 4.0 * (sector.edges[1] - vertex) + sector.diagonals[0] + sector.diagonals[1] - ends;
  const CreaseWeights weights = creaseWeights(k);
  const double turn = M_PI / double(k);
  glm::dvec3 across = weights.vertex * vertex + weights.crease * ends;
  for (size_t i = 0; i < k; ++i) {
    const double at = std::sin(turn * double(i)), then = std::sin(turn * double(i + 1));
    if (i > 0) across += weights.edge * at * sector.edges[i];
    across += weights.diagonal * (at + then) * sector.diagonals[i];
  }
  return across;
}

glm::dvec3 creaseNormal(glm::dvec3 vertex, const Sector& sector) {
  return glm::cross(sector.edges.front() - sector.edges.back(), acrossCrease(vertex, sector));
}

}  // namespace

PolygonMesh catmullClark(const PolygonMesh& mesh, Fans fans) { return Step(mesh, fans).result(); }

PolygonMesh catmullClark(PolygonMesh mesh, int steps) {
  for (int i = 0; i < steps; ++i) mesh = catmullClark(mesh);
  return mesh;
}

LimitPoints catmullClarkLimit(const PolygonMesh& mesh, Fans fans) {
  const MeshTopology topology(mesh, fans);
  for (const std::vector<uint32_t>& face : mesh.faces)
    if (face.size() != 4) throw std::invalid_argument("the limit is known for quads only");
  for (const auto& [edge, s] : mesh.sharpness)
    if (s > 0.0 && s < kInfinitelySharp) throw std::invalid_argument("an edge is neither smooth nor sharp");
  LimitPoints out;
  out.normals.resize(mesh.faces.size());
  for (uint32_t v = 0; v < mesh.points.size(); ++v) {
    const VertexRing& ring = topology.rings()[v];
    const glm::dvec3& p = mesh.points[v];
    if (ring.faces.empty()) {
      out.points.push_back(p);
      continue;
    }
    const std::vector<uint32_t> sharp = sharpEnds(mesh, topology, v);
    const size_t n = ring.faces.size();
    const bool smooth = sharp.size() < 2;
    const bool corner = sharp.size() > 2 || (!ring.closed && n == 1);
    std::optional<DartLimit> dart;
    if (sharp.size() == 1) {
      std::vector<glm::dvec3> edges, diagonals;
      for (const uint32_t end : ring.edges) edges.push_back(mesh.points[end]);
      for (const uint32_t face : ring.faces) diagonals.push_back(farCorner(mesh, face, v));
      const auto place = std::find(ring.edges.begin(), ring.edges.end(), sharp[0]) - ring.edges.begin();
      dart = catmullClarkDart(p, edges, diagonals, static_cast<size_t>(place));
      out.points.push_back(dart->point);
    } else if (smooth) {
      glm::dvec3 edges(0.0), diagonals(0.0);
      for (const uint32_t end : ring.edges) edges += mesh.points[end];
      for (const uint32_t face : ring.faces) diagonals += farCorner(mesh, face, v);
      const auto k = double(n);
      out.points.push_back((k * k * p + 4.0 * edges + diagonals) / (k * (k + 5.0)));
    } else if (corner) {
      out.points.push_back(p);
    } else {
      out.points.push_back((4.0 * p + mesh.points[sharp[0]] + mesh.points[sharp[1]]) / 6.0);
    }
    // Sectors between sharp edges; a ring without any starts anywhere.
    const auto isSharp = [&](size_t edge) {
      return std::find(sharp.begin(), sharp.end(), ring.edges[edge % ring.edges.size()]) != sharp.end();
    };
    size_t start = 0;
    if (!smooth && ring.closed)
      while (!isSharp(start)) ++start;
    Sector sector;
    for (size_t i = 0; i < n; ++i) {
      const size_t place = (start + i) % n;
      if (sector.edges.empty()) sector.edges.push_back(mesh.points[ring.edges[place]]);
      sector.faces.push_back(place);
      sector.diagonals.push_back(farCorner(mesh, ring.faces[place], v));
      const bool last = i + 1 == n;
      if (!(last && smooth)) sector.edges.push_back(mesh.points[ring.edges[(place + 1) % ring.edges.size()]]);
      if (!last && (smooth || !isSharp(place + 1))) continue;
      const glm::dvec3 across = dart     ? dart->normal
                                : smooth ? smoothNormal(sector)
                                : corner ? glm::cross(sector.edges.front() - p, sector.edges.back() - p)
                                         : creaseNormal(p, sector);
      const double length = glm::length(across);
      const glm::dvec3 normal = length > 0.0 ? across / length : glm::dvec3(0.0, 0.0, 1.0);
      for (const size_t at : sector.faces) {
        const std::vector<uint32_t>& face = mesh.faces[ring.faces[at]];
        const auto c = std::find(face.begin(), face.end(), v) - face.begin();
        out.normals[ring.faces[at]][static_cast<size_t>(c)] = normal;
      }
      sector = {};
    }
  }
  return out;
}

}  // namespace limen::surfaces
