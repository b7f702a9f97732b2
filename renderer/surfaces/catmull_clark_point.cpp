// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/catmull_clark_point.h"

#include <algorithm>
#include <optional>

#include "renderer/surfaces/catmull_clark.h"
#include "renderer/surfaces/sharpness_rules.h"

namespace limen::surfaces {
namespace {

using Grid = std::array<std::array<glm::dvec3, 4>, 4>;  // [x + 1][y + 1]

/// The 4 x 4 control points around face 0 if its vertices are regular.
std::optional<Grid> regularGrid(const PolygonMesh& mesh, const MeshTopology& topology) {
  Grid grid;
  const std::vector<uint32_t>& own = mesh.faces[0];
  for (size_t corner = 0; corner < 4; ++corner) {
    const VertexRing& ring = topology.rings()[own[corner]];
    if (!ring.closed || ring.faces.size() != 4) return std::nullopt;
    for (const uint32_t end : ring.edges)
      if (topology.sharpness(mesh, edgeKey(own[corner], end)) > 0.0) return std::nullopt;
    const auto j =
        static_cast<size_t>(std::find(ring.faces.begin(), ring.faces.end(), 0U) - ring.faces.begin());
    // Seen from this corner: x towards the next one, y towards the one before.
    const auto put = [&](int x, int y, glm::dvec3 p) {
      glm::ivec2 at(x, y);
      for (size_t turn = 0; turn < corner; ++turn) at = {-at.y, at.x};
      const std::array<glm::ivec2, 4> origin = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
      at += origin[corner] + 1;
      grid[static_cast<size_t>(at.x)][static_cast<size_t>(at.y)] = p;
    };
    const auto edge = [&](size_t i) { return mesh.points[ring.edges[(j + i) % 4]]; };
    const auto diagonal = [&](size_t i) {
      const std::vector<uint32_t>& face = mesh.faces[ring.faces[(j + i) % 4]];
      const auto at = std::find(face.begin(), face.end(), own[corner]) - face.begin();
      return mesh.points[face[static_cast<size_t>(at + 2) % 4]];
    };
    put(0, 0, mesh.points[own[corner]]);
    put(-1, 0, edge(2)), put(0, -1, edge(3)), put(-1, -1, diagonal(2));
  }
  return grid;
}

/// Uniform cubic B-spline basis and its derivative.
std::array<double, 4> basis(double t) {
  const double s = 1.0 - t;
  return {s * s * s / 6.0, (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0,
          (3.0 * s * s * s - 6.0 * s * s + 4.0) / 6.0, t * t * t / 6.0};
}
std::array<double, 4> slope(double t) {
  const double s = 1.0 - t;
  return {-0.5 * s * s, 1.5 * t * t - 2.0 * t, -1.5 * s * s + 2.0 * s, 0.5 * t * t};
}

LimitPoint inRegularFace(const Grid& grid, double u, double v, int steps) {
  const auto sum = [&](const std::array<double, 4>& a, const std::array<double, 4>& b) {
    glm::dvec3 out(0.0);
    for (size_t x = 0; x < 4; ++x)
      for (size_t y = 0; y < 4; ++y) out += a[x] * b[y] * grid[x][y];
    return out;
  };
  const glm::dvec3 normal = glm::cross(sum(slope(u), basis(v)), sum(basis(u), slope(v)));
  const double length = glm::length(normal);
  return {sum(basis(u), basis(v)), length > 0.0 ? normal / length : glm::dvec3(0.0, 0.0, 1.0), steps};
}

}  // namespace

LimitPoint catmullClarkPoint(const PolygonMesh& mesh, uint32_t face, double u, double v, int mostSteps) {
  PolygonMesh around = surroundings(mesh, face);
  glm::dvec3 origin(0.0);
  for (int steps = 0;; ++steps) {
    // Faces shrink below the rounding of their position.
    const glm::dvec3 start = around.points[0];
    for (glm::dvec3& p : around.points) p -= start;
    origin += start;
    const MeshTopology topology(around, Fans::Any);
    if (const std::optional<Grid> grid = regularGrid(around, topology)) {
      LimitPoint point = inRegularFace(*grid, u, v, steps);
      point.position += origin;
      return point;
    }
    // The child at the nearest corner, seen from that corner: x towards the next one.
    const size_t corner = u < 0.5 ? (v < 0.5 ? 0 : 3) : (v < 0.5 ? 1 : 2);
    // Semi-sharp edges have become smooth by now.
    if (steps >= std::max(mostSteps, int(kInfinitelySharp))) {
      const LimitPoints limit = catmullClarkLimit(around, Fans::Any);
      return {origin + limit.points[around.faces[0][corner]], limit.normals[0][corner], steps};
    }
    const std::array<glm::dvec2, 4> seen = {{{u, v}, {v, 1.0 - u}, {1.0 - u, 1.0 - v}, {1.0 - v, u}}};
    u = 2.0 * seen[corner].x, v = 2.0 * seen[corner].y;
    around = surroundings(catmullClark(around, Fans::Any), static_cast<uint32_t>(corner));
  }
}

}  // namespace limen::surfaces
