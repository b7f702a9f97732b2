// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/loop_point.h"

#include "renderer/surfaces/bezier.h"
#include "renderer/surfaces/loop_subdivision.h"
#include "renderer/surfaces/sharpness_rules.h"

namespace limen::surfaces {
namespace {

// Coefficients of a^i b^j c^k, i + j + k = 4, in the twelve-fold basis functions; rows i = 4 to 0, in each
// c's power rising: a^4, a^3 b, a^3 c, a^2 b^2, a^2 b c, a^2 c^2, a b^3, ... c^4.
using Quartic = std::array<double, 15>;
constexpr Quartic kCorner = {6, 24, 24, 24, 60, 24, 8, 36, 36, 8, 1, 6, 12, 6, 1};  ///< the vertex of a
constexpr Quartic kAcross = {1, 6, 2, 12, 6, 0, 6, 6, 0, 0, 1, 2, 0, 0, 0};  ///< beyond the edge from a to b
constexpr Quartic kTip = {1, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};  ///< at a, beside the one beyond a b
constexpr std::array<double, 15> kMultinomial = {1, 4, 4, 6, 12, 6, 4, 12, 12, 4, 1, 4, 6, 4, 1};

size_t place(int i, int k) { return static_cast<size_t>((4 - i) * (5 - i) / 2 + k); }

class Net {
 public:
  /// Adds a point with a basis function whose a and b are the given corners of the face.
  void add(glm::dvec3 p, const Quartic& basis, size_t a, size_t b) {
    const size_t c = 3 - a - b;
    for (int i = 0; i <= 4; ++i)
      for (int k = 0; i + k <= 4; ++k) {
        std::array<int, 3> power{};
        power[a] = i, power[b] = 4 - i - k, power[c] = k;
        const size_t from = place(i, k), to = place(power[0], power[2]);
        points[to] += p * (basis[from] / (12.0 * kMultinomial[from]));
      }
  }
  std::array<glm::dvec3, 15> points{};
};

}  // namespace

std::optional<std::array<glm::dvec3, 15>> loopTriangle(const PolygonMesh& mesh, const MeshTopology& topology,
                                                       uint32_t face) {
  const std::vector<uint32_t>& own = mesh.faces[face];
  Net net;
  for (size_t a = 0; a < 3; ++a) {
    const VertexRing& ring = topology.rings()[own[a]];
    if (!ring.closed || ring.faces.size() != 6 || !sharpEnds(mesh, topology, own[a]).empty())
      return std::nullopt;
    const auto first =
        static_cast<size_t>(std::find(ring.faces.begin(), ring.faces.end(), face) - ring.faces.begin());
    const auto edge = [&](size_t i) { return mesh.points[ring.edges[(first + i) % 6]]; };
    const size_t next = (a + 1) % 3, previous = (a + 2) % 3;
    net.add(mesh.points[own[a]], kCorner, a, next);
    net.add(edge(5), kAcross, a, next);
    net.add(edge(4), kTip, a, next);
    net.add(edge(3), kTip, a, previous);
  }
  return net.points;
}

LimitPoint loopPoint(const PolygonMesh& mesh, uint32_t face, double u, double v, int mostSteps) {
  PolygonMesh around = surroundings(mesh, face);
  glm::dvec3 origin(0.0);
  for (int steps = 0;; ++steps) {
    // Faces shrink below the rounding of their position.
    const glm::dvec3 start = around.points[0];
    for (glm::dvec3& p : around.points) p -= start;
    origin += start;
    const MeshTopology topology(around, Fans::Any);
    if (const auto net = loopTriangle(around, topology, 0)) {
      const SurfaceJet jet = triangleJet(4, net->data(), trianglePoint(u, v), Order::First);
      const glm::dvec3 normal = glm::cross(jet.u, jet.v);
      const double length = glm::length(normal);
      return {origin + jet.p, length > 0.0 ? normal / length : glm::dvec3(0.0, 0.0, 1.0), steps};
    }
    const double w = 1.0 - u - v;
    // Semi-sharp edges have become smooth by now.
    if (steps >= std::max(mostSteps, int(kInfinitelySharp))) {
      const size_t corner = u > v ? (u > w ? 0 : 2) : (v > w ? 1 : 2);
      const LoopLimit limit = loopLimit(around, Fans::Any);
      return {origin + limit.points[around.faces[0][corner]], limit.normals[0][corner], steps};
    }
    uint32_t child = 3;
    // Weights of the child's vertices; the middle one's lie on the edges u v, v w and w u.
    glm::dvec3 inside(1.0 - 2.0 * w, 1.0 - 2.0 * u, 1.0 - 2.0 * v);
    if (u >= 0.5)
      child = 0, inside = {2.0 * u - 1.0, 2.0 * v, 2.0 * w};
    else if (v >= 0.5)
      child = 1, inside = {2.0 * v - 1.0, 2.0 * w, 2.0 * u};
    else if (w >= 0.5)
      child = 2, inside = {2.0 * w - 1.0, 2.0 * u, 2.0 * v};
    u = inside.x, v = inside.y;
    around = surroundings(loop(around, Fans::Any), child);
  }
}

}  // namespace limen::surfaces
