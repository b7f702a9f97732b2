// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/pccm_patches.h"

#include <algorithm>

#include "renderer/surfaces/acc_masks.h"
#include "renderer/surfaces/neighbours.h"
#include "renderer/surfaces/patch_builder.h"

namespace limen::surfaces {
namespace {

using glm::dvec3;

/// [along][across], from a corner: of the patch next to it, along the side that leaves the corner, and along
/// the one that comes to it.
using CornerNet = std::array<std::array<dvec3, 3>, 3>;
/// Control points of a quad's four patches, [u][v]; those with index 3 are shared.
using QuadNet = std::array<std::array<dvec3, 7>, 7>;

/// What the quads around an extraordinary vertex have in common, by ring edge.
struct SplitRing {
  dvec3 centre{0.0};
  std::vector<dvec3> first, second, third;  ///< control points 1 to 3 of the edge
  std::vector<dvec3> shift;                 ///< of control point 4, and of those beside it
  std::vector<dvec3> left, right;           ///< beside `second`: in face i, and in face i - 1
  std::vector<dvec3> twist;                 ///< beside the centre, by face
};

class QuadSplines {
 public:
  explicit QuadSplines(const PolygonMesh& mesh) : mesh_(mesh), topology_(mesh), masks_(mesh) {
    splits_.resize(mesh.points.size());
    for (uint32_t v = 0; v < mesh.points.size(); ++v)
      if (isExtraordinary(v)) splits_[v] = splitRing(v);
  }

  QuadNet netOf(uint32_t face) const {
    const std::vector<uint32_t>& corners = mesh_.faces[face];
    QuadNet net{};
    for (size_t c = 0; c < 4; ++c) {
      if (isExtraordinary(corners[c])) continue;
      const CornerNet own = regularNet(face, c);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) at(net, c, i, j) = own[size_t(i)][size_t(j)];
    }
    for (size_t c = 0; c < 4; ++c)
      if (isExtraordinary(corners[c])) setSplit(net, face, c);
    // C1 at the knots.
    for (size_t k = 0; k < 7; ++k)
      if (k != 3) {
        net[3][k] = 0.5 * (net[2][k] + net[4][k]);
        net[k][3] = 0.5 * (net[k][2] + net[k][4]);
      }
    net[3][3] = 0.25 * ((net[2][2] + net[4][4]) + (net[2][4] + net[4][2]));
    return net;
  }

 private:
  bool isExtraordinary(uint32_t v) const {
    const VertexRing& ring = topology_.rings()[v];
    if (ring.faces.empty()) return false;
    if (ring.closed) return ring.faces.size() != 4;
    if (ring.faces.size() > 2) throw std::invalid_argument("an extraordinary vertex lies on a boundary");
    return false;
  }

  /// Of a quad's net seen from a corner: i along the side that leaves it.
  static dvec3& at(QuadNet& net, size_t corner, int i, int j) {
    const std::array<std::array<int, 2>, 4> places = {{{i, j}, {6 - j, i}, {6 - i, 6 - j}, {j, 6 - i}}};
    return net[size_t(places[corner][0])][size_t(places[corner][1])];
  }

  size_t cornerOf(uint32_t face, uint32_t vertex) const {
    const std::vector<uint32_t>& v = mesh_.faces[face];
    return size_t(std::find(v.begin(), v.end(), vertex) - v.begin());
  }
  size_t placeInRing(uint32_t vertex, uint32_t face) const {
    const std::vector<uint32_t>& faces = topology_.rings()[vertex].faces;
    return size_t(std::find(faces.begin(), faces.end(), face) - faces.begin());
  }

  /// The vertices around a regular one, [x + 1][y + 1], x along the side that leaves it. Beyond a boundary
  /// those are missing that make the rules of the inside give the boundary's.
  std::array<std::array<dvec3, 3>, 3> regularRing(uint32_t face, size_t corner) const {
    const uint32_t vertex = mesh_.faces[face][corner];
    const VertexRing& ring = topology_.rings()[vertex];
    const auto own = static_cast<int>(placeInRing(vertex, face));
    std::array<std::array<dvec3, 3>, 3> out{};
    std::array<std::array<bool, 3>, 3> known{};
    const auto set = [&](glm::ivec2 place, dvec3 p) {
      out[size_t(place.x + 1)][size_t(place.y + 1)] = p;
      known[size_t(place.x + 1)][size_t(place.y + 1)] = true;
    };
    set({0, 0}, mesh_.points[vertex]);
    glm::ivec2 way(1, 0);
    for (int k = 0; k < 4; ++k) {
      const glm::ivec2 next(-way.y, way.x);
      const auto edges = static_cast<int>(ring.edges.size()), faces = static_cast<int>(ring.faces.size());
      const int edge = ring.closed ? (own + k) % edges : (own + k < edges ? own + k : own + k - 4);
      if (edge >= 0) set(way, mesh_.points[ring.edges[size_t(edge)]]);
      const int f = ring.closed ? (own + k) % faces : (own + k < faces ? own + k : own + k - 4);
      if (f >= 0 && f < faces) {
        const uint32_t of = ring.faces[size_t(f)];
        set(way + next, mesh_.points[mesh_.faces[of][(cornerOf(of, vertex) + 2) % 4]]);
      }
      way = next;
    }
    for (size_t k = 0; k < 3; ++k) {
      if (!known[k][0] && known[k][1]) out[k][0] = 2.0 * out[k][1] - out[k][2], known[k][0] = true;
      if (!known[k][2] && known[k][1]) out[k][2] = 2.0 * out[k][1] - out[k][0], known[k][2] = true;
    }
    for (size_t k = 0; k < 3; ++k) {
      if (!known[0][k]) out[0][k] = 2.0 * out[1][k] - out[2][k];
      if (!known[2][k]) out[2][k] = 2.0 * out[1][k] - out[0][k];
    }
    return out;
  }

  /// A uniform B-spline's first three control points right of a knot, on half the span.
  static constexpr std::array<dvec3, 3> kHalfSpan = {
      {{1.0 / 6, 4.0 / 6, 1.0 / 6}, {1.0 / 12, 8.0 / 12, 3.0 / 12}, {1.0 / 24, 14.0 / 24, 9.0 / 24}}};
  static dvec3 spline(size_t k, dvec3 before, dvec3 on, dvec3 after) {
    const dvec3& w = kHalfSpan[k];
    return k == 0 ? 4.0 / 6 * on + 1.0 / 6 * (before + after) : w[1] * on + (w[0] * before + w[2] * after);
  }

  /// Both quads along a side get the same bits of it: sums across the side come first.
  CornerNet regularNet(uint32_t face, size_t corner) const {
    const std::array<std::array<dvec3, 3>, 3> p = regularRing(face, corner);
    CornerNet out;
    for (size_t i = 0; i < 3; ++i)
      for (size_t j = 0; j < 3; ++j) {
        std::array<dvec3, 3> sums;
        for (size_t k = 0; k < 3; ++k)
          sums[k] = i == 0 ? spline(0, p[0][k], p[1][k], p[2][k]) : spline(j, p[k][0], p[k][1], p[k][2]);
        out[i][j] = i == 0 ? spline(j, sums[0], sums[1], sums[2]) : spline(i, sums[0], sums[1], sums[2]);
      }
    // The corner itself is seen from four sides.
    out[0][0] = 16.0 / 36 * p[1][1] + 4.0 / 36 * ((p[0][1] + p[2][1]) + (p[1][0] + p[1][2])) +
                1.0 / 36 * ((p[0][0] + p[2][2]) + (p[0][2] + p[2][0]));
    return out;
  }

  /// From the bicubic patch that approximates a quad, seen from a corner, the first half of both spans.
  std::array<std::array<dvec3, 3>, 3> guess(uint32_t face, size_t corner) const {
    const std::vector<uint32_t>& v = mesh_.faces[face];
    const auto vertex = [&](size_t k) { return v[(corner + k) % 4]; };
    const std::array<std::array<dvec3, 3>, 3> b = {
        {{masks_.corner(vertex(0)), masks_.edge(vertex(0), vertex(3)), masks_.edge(vertex(3), vertex(0))},
         {masks_.edge(vertex(0), vertex(1)), masks_.inner(face, corner),
          masks_.inner(face, (corner + 3) % 4)},
         {masks_.edge(vertex(1), vertex(0)), masks_.inner(face, (corner + 1) % 4),
          masks_.inner(face, (corner + 2) % 4)}}};
    std::array<std::array<dvec3, 3>, 3> out;
    const std::array<dvec3, 3> halves = {{{1.0, 0.0, 0.0}, {0.5, 0.5, 0.0}, {0.25, 0.5, 0.25}}};
    for (size_t i = 0; i < 3; ++i)
      for (size_t j = 0; j < 3; ++j) {
        out[i][j] = dvec3(0.0);
        for (int k = 0; k < 3; ++k)
          for (int l = 0; l < 3; ++l) out[i][j] += halves[i][k] * halves[j][l] * b[size_t(k)][size_t(l)];
      }
    return out;
  }

  SplitRing splitRing(uint32_t vertex) const {
    const VertexRing& ring = topology_.rings()[vertex];
    const size_t n = ring.faces.size();
    SplitRing out;
    out.centre = masks_.corner(vertex);
    std::vector<dvec3> fourth;
    for (size_t k = 0; k < n; ++k) {
      if (isExtraordinary(ring.edges[k]))
        throw std::invalid_argument("a face has two extraordinary vertices");
      const uint32_t face = ring.faces[k];
      const size_t corner = cornerOf(face, vertex);
      if (isExtraordinary(mesh_.faces[face][(corner + 2) % 4]))
        throw std::invalid_argument("a face has two extraordinary vertices");
      fourth.push_back(regularNet(face, (corner + 1) % 4)[0][2]);
    }
    // Twists exist around a vertex of even valence if these sum to nothing with alternating signs.
    dvec3 alternating(0.0);
    if (n % 2 == 0)
      for (size_t k = 0; k < n; ++k) alternating += (k % 2 == 0 ? 1.0 : -1.0) / double(n) * fourth[k];
    std::vector<dvec3> twists;  // what those on either side of an edge sum to
    const double cosine = std::cos(2.0 * std::numbers::pi / double(n));
    for (size_t k = 0; k < n; ++k) {
      out.shift.push_back((k % 2 == 0 ? -1.0 : 1.0) * alternating);
      const dvec3 tangent = masks_.tangent(vertex, ring.edges[k]) / 6.0;
      const dvec3 q1 = out.centre + 1.5 * tangent, q2 = (2.0 * q1 + 3.0 * (fourth[k] + out.shift[k])) / 5.0;
      out.first.push_back(out.centre + tangent);
      out.second.push_back((2.0 * q1 + q2) / 3.0);
      out.third.push_back(q2);
      twists.push_back(2.0 * out.first[k] + 4.0 * cosine / 9.0 * (q2 - q1));
    }
    std::vector<std::array<std::array<dvec3, 3>, 3>> guesses;
    for (const uint32_t face : ring.faces) guesses.push_back(guess(face, cornerOf(face, vertex)));
    for (size_t k = 0; k < n; ++k) {
      const dvec3 half = 0.5 * (guesses[k][2][1] - guesses[(k + n - 1) % n][1][2]);
      out.left.push_back(out.second[k] + half);
      out.right.push_back(out.second[k] - half);
    }
    out.twist = twistsFrom(twists, [&](size_t k) { return guesses[k][1][1]; });
    return out;
  }

  /// x_k with x_k + x_(k - 1) = sums[k]; for even numbers the ones nearest to `near`.
  template <class Near>
  static std::vector<dvec3> twistsFrom(const std::vector<dvec3>& sums, Near near) {
    const size_t n = sums.size();
    std::vector<dvec3> out(n, dvec3(0.0));
    if (n % 2 == 1) {
      for (size_t k = 0; k < n; ++k)
        for (size_t m = 0; m < n; ++m) out[k] += (m % 2 == 0 ? 0.5 : -0.5) * sums[(k + n - m) % n];
      return out;
    }
    for (size_t k = 1; k < n; ++k) out[k] = sums[k] - out[k - 1];
    dvec3 free(0.0);
    for (size_t k = 0; k < n; ++k) free += (k % 2 == 0 ? 1.0 : -1.0) / double(n) * (near(k) - out[k]);
    for (size_t k = 0; k < n; ++k) out[k] += (k % 2 == 0 ? 1.0 : -1.0) * free;
    return out;
  }

  void setSplit(QuadNet& net, uint32_t face, size_t corner) const {
    const uint32_t vertex = mesh_.faces[face][corner];
    const SplitRing& split = splits_[vertex];
    const size_t k = placeInRing(vertex, face), next = (k + 1) % split.first.size();
    at(net, corner, 0, 0) = split.centre;
    at(net, corner, 1, 0) = split.first[k], at(net, corner, 0, 1) = split.first[next];
    at(net, corner, 2, 0) = split.second[k], at(net, corner, 0, 2) = split.second[next];
    at(net, corner, 1, 1) = split.twist[k];
    at(net, corner, 2, 1) = split.left[k], at(net, corner, 1, 2) = split.right[next];
    at(net, corner, 2, 2) = guess(face, corner)[2][2];
    for (int j = 0; j < 3; ++j) {
      at(net, corner, 4, j) += split.shift[k];
      at(net, corner, j, 4) += split.shift[next];
    }
  }

  const PolygonMesh& mesh_;
  MeshTopology topology_;
  AccMasks masks_;
  std::vector<SplitRing> splits_;
};

}  // namespace

PatchSet pccmPatches(const PolygonMesh& mesh) {
  const QuadSplines splines(mesh);
  PatchSet set;
  for (uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const QuadNet net = splines.netOf(f);
    for (size_t b = 0; b < 2; ++b)
      for (size_t a = 0; a < 2; ++a) {
        std::array<glm::dvec4, 16> points;
        for (size_t i = 0; i < 4; ++i)
          for (size_t j = 0; j < 4; ++j) points[i + 4 * j] = glm::dvec4(net[3 * a + i][3 * b + j], 1.0);
        addRectangle(set, 3, 3, points);
      }
  }
  findNeighbours(set);
  return set;
}

}  // namespace limen::surfaces
