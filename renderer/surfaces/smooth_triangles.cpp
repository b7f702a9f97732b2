// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/smooth_triangles.h"

#include <algorithm>
#include <cmath>

#include "renderer/surfaces/bezier.h"
#include "renderer/surfaces/mesh_edges.h"
#include "renderer/surfaces/neighbours.h"
#include "renderer/surfaces/patch_builder.h"
#include "renderer/surfaces/pn_set.h"

namespace limen::surfaces {
namespace {

using glm::dvec3;

/// Domain point at a share of the way along a side.
glm::dvec2 onSide(int side, double t) {
  const std::array<dvec3, 3> corners = {dvec3(1, 0, 0), {0, 1, 0}, {0, 0, 1}};
  const auto s = static_cast<size_t>(side);
  return glm::dvec2(glm::mix(corners[s], corners[(s + 1) % 3], t));
}

SurfaceJet jetAt(const PnTriangle& triangle, glm::dvec2 at) {
  return triangleJet(3, triangle.points.data(), trianglePoint(at.x, at.y), Order::First);
}

/// Derivatives along the side and towards the opposite corner.
struct SideFrame {
  dvec3 along, across;
};
SideFrame frameOf(const PnTriangle& triangle, int side, double t) {
  const glm::dvec2 at = onSide(side, t), apex = onSide((side + 2) % 3, 0.0);
  const SurfaceJet jet = jetAt(triangle, at);
  return {jet.along(kTriangleSides[static_cast<size_t>(side)]), jet.along(apex - at)};
}

/// The normal field of PN triangles on a side, turned across the curve.
dvec3 normalOnSide(const PnBase& base, const PnTriangle& triangle, int side, double t) {
  const auto s = static_cast<size_t>(side);
  const dvec3 a = base.normals[s], b = base.normals[(s + 1) % 3];
  const dvec3 middle =
      pnMiddleNormal(base.positions[s], base.positions[(s + 1) % 3], a, b, {PnNormals::CorrectedFarin, true});
  const dvec3 field = (1 - t) * (1 - t) * a + 2.0 * t * (1 - t) * middle + t * t * b;
  const dvec3 along = frameOf(triangle, side, t).along;
  const double squared = glm::dot(along, along);
  const dvec3 across = squared > 0.0 ? field - glm::dot(field, along) / squared * along : field;
  const double length = glm::length(across);
  return length > 0.0 ? across / length : dvec3(0.0);
}

/// Shares of the sides w = 0, u = 0, v = 0: 1 on the side itself, and 0 on the two others, as are its
/// derivatives. At corners, where the sides' surfaces agree, they have no limit.
dvec3 sideShares(double u, double v, double w) {
  const dvec3 squares(u * u * v * v, v * v * w * w, w * w * u * u);
  const double sum = squares.x + squares.y + squares.z;
  return sum > 0.0 ? squares / sum : dvec3(1.0 / 3.0);
}

}  // namespace

SmoothTriangle::SmoothTriangle(Smoothing smoothing, const PnBase& base,
                               std::array<std::optional<Beyond>, 3> beyond)
    : smoothing_(smoothing), base_(base), triangle_(pnTriangle(base)), beyond_(std::move(beyond)) {}

dvec3 SmoothTriangle::sideNormal(int side, double t) const {
  if (smoothing_ == Smoothing::SideVertex) return normalOnSide(base_, triangle_, side, t);
  const auto& beyond = beyond_[static_cast<size_t>(side)];
  if (!beyond) return dvec3(0.0);
  const SideFrame own = frameOf(triangle_, side, t), other = frameOf(beyond->triangle, beyond->side, 1.0 - t);
  const dvec3 normal = glm::cross(own.along, own.across - other.across);
  const double length = glm::length(normal);
  return length > 1e-12 * glm::dot(own.along, own.along) ? normal / length : dvec3(0.0);
}

dvec3 SmoothTriangle::sideVertex(double u, double v, double w) const {
  const dvec3 shares = sideShares(u, v, w);
  const std::array<double, 3> away = {w, u, v}, from = {u, v, w};
  const dvec3 flat = triangleJet(3, triangle_.points.data(), trianglePoint(u, v), Order::Position).p;
  dvec3 out(0.0);
  for (size_t s = 0; s < 3; ++s) {
    if (shares[static_cast<int>(s)] == 0.0) continue;
    const double r = away[s], rest = 1.0 - r;
    const size_t apex = (s + 2) % 3;
    if (rest <= 0.0) return base_.positions[apex];
    const double t = 1.0 - from[s] / rest;
    const glm::dvec2 foot = onSide(static_cast<int>(s), t);
    const dvec3 a = jetAt(triangle_, foot).p, b = base_.positions[apex];
    const dvec3 normal = normalOnSide(base_, triangle_, static_cast<int>(s), t);
    const dvec3 &far = base_.normals[apex], edge = b - a;
    const dvec3 first = a + (edge - glm::dot(edge, normal) * normal) / 3.0,
                second = b - (edge - glm::dot(edge, far) * far) / 3.0;
    const dvec3 curve =
        rest * rest * rest * a + 3.0 * r * rest * rest * first + 3.0 * r * r * rest * second + r * r * r * b;
    const double parallel = beyond_[s] ? std::max(beyond_[s]->faceCosine, 0.0) : 0.0;
    out += shares[static_cast<int>(s)] * glm::mix(curve, flat, 27.0 * u * v * w * parallel);
  }
  return out;
}

dvec3 SmoothTriangle::tangentPlanes(double u, double v, double w) const {
  const dvec3 shares = sideShares(u, v, w);
  const std::array<double, 3> away = {w, u, v}, from = {u, v, w};
  dvec3 out = triangleJet(3, triangle_.points.data(), trianglePoint(u, v), Order::Position).p;
  for (size_t s = 0; s < 3; ++s) {
    const double rest = 1.0 - away[s];
    if (away[s] <= 0.0 || rest <= 0.0 || shares[static_cast<int>(s)] == 0.0) continue;
    const double t = 1.0 - from[s] / rest;
    const dvec3 normal = sideNormal(static_cast<int>(s), t);
    const dvec3 across = frameOf(triangle_, static_cast<int>(s), t).across;
    out -= shares[static_cast<int>(s)] * away[s] * glm::dot(across, normal) * normal;
  }
  return out;
}

dvec3 SmoothTriangle::position(double u, double v, double w) const {
  return smoothing_ == Smoothing::SideVertex ? sideVertex(u, v, w) : tangentPlanes(u, v, w);
}

dvec3 SmoothTriangle::normal(double u, double v, double w) const {
  const std::array<double, 3> at = {u, v, w};
  for (size_t c = 0; c < 3; ++c)
    if (at[c] >= 1.0) return base_.normals[c];
  // Towards the two corners that are farther away; differences of second order, within the domain.
  const auto nearest = static_cast<size_t>(std::max_element(at.begin(), at.end()) - at.begin());
  constexpr double kStep = 1e-5;
  const auto moved = [&](size_t corner, double step) {
    std::array<double, 3> p = at;
    p[nearest] -= step, p[corner] += step;
    return position(p[0], p[1], p[2]);
  };
  const auto slope = [&](size_t corner) {
    return -3.0 * moved(corner, 0.0) + 4.0 * moved(corner, kStep) - moved(corner, 2.0 * kStep);
  };
  const dvec3 normal = glm::cross(slope((nearest + 1) % 3), slope((nearest + 2) % 3));
  const double length = glm::length(normal);
  return length > 0.0 ? normal / length : base_.normals[nearest];
}

std::vector<SmoothTriangle> smoothTriangles(const BaseMesh& mesh, Smoothing smoothing) {
  const std::vector<PnBase> bases = pnBases(mesh);
  const auto faceNormal = [&](uint32_t t) {
    const auto& p = bases[t].positions;
    const dvec3 n = glm::cross(p[1] - p[0], p[2] - p[0]);
    const double length = glm::length(n);
    return length > 0.0 ? n / length : dvec3(0.0);
  };
  std::vector<std::array<std::optional<SmoothTriangle::Beyond>, 3>> beyond(bases.size());
  for (const MeshEdge& edge : edgesOf(mesh.triangles)) {
    if (edge.sides != 2) continue;
    std::array<int, 2> sides{};
    bool crease = false;
    for (size_t i = 0; i < 2; ++i)
      for (int s = 0; s < 3; ++s) {
        const glm::uvec3& t = mesh.triangles[edge.triangles[i]];
        if (std::array{std::min(t[s], t[(s + 1) % 3]), std::max(t[s], t[(s + 1) % 3])} != edge.vertices)
          continue;
        sides[i] = s;
        for (const auto& normal : bases[edge.triangles[i]].creases[static_cast<size_t>(s)])
          crease |= normal.has_value();
      }
    if (crease) continue;
    for (size_t i = 0; i < 2; ++i)
      beyond[edge.triangles[i]][static_cast<size_t>(sides[i])] =
          SmoothTriangle::Beyond{pnTriangle(bases[edge.triangles[1 - i]]), sides[1 - i],
                                 glm::dot(faceNormal(edge.triangles[0]), faceNormal(edge.triangles[1]))};
  }
  std::vector<SmoothTriangle> out;
  for (size_t t = 0; t < bases.size(); ++t) out.emplace_back(smoothing, bases[t], beyond[t]);
  return out;
}

namespace {

/// Inner control point next to `a` of a cubic through four evenly spaced points: bit by bit the same for the
/// curve that runs the other way.
dvec3 cubicPoint(dvec3 a, dvec3 b, dvec3 c, dvec3 d) {
  return ((18.0 * b - 5.0 * a) + (2.0 * d - 9.0 * c)) / 6.0;
}

/// Point of a PN triangle's side, the same for both triangles.
dvec3 sidePosition(const PnTriangle& triangle, int side, int q, int n) {
  static constexpr std::array<std::array<size_t, 4>, 3> kSides = {{{0, 1, 3, 6}, {6, 7, 8, 9}, {9, 5, 2, 0}}};
  const auto& at = kSides[static_cast<size_t>(side)];
  const auto& p = triangle.points;
  const double t = double(q) / n, s = double(n - q) / n;
  return (s * s * s * p[at[0]] + t * t * t * p[at[3]]) +
         (3.0 * (s * s * t) * p[at[1]] + 3.0 * (t * t * s) * p[at[2]]);
}

}  // namespace

PatchSet smoothSet(const BaseMesh& mesh, Smoothing smoothing, int pieces) {
  const std::vector<PnBase> bases = pnBases(mesh);
  const std::vector<SmoothTriangle> triangles = smoothTriangles(mesh, smoothing);
  const int n = 3 * pieces, half = 2 * pieces;
  PatchSet set;
  for (size_t t = 0; t < triangles.size(); ++t) {
    const PnTriangle pn = pnTriangle(bases[t]);
    const auto at = [&](int i, int j) {  // u = i / n, v = j / n
      const int k = n - i - j;
      if (k == 0) return sidePosition(pn, 0, j, n);
      if (i == 0) return sidePosition(pn, 1, k, n);
      return j == 0 ? sidePosition(pn, 2, i, n)
                    : triangles[t].position(double(i) / n, double(j) / n, double(k) / n);
    };
    const auto normalAt = [&](int i, int j) {
      return triangles[t].normal(double(i) / half, double(j) / half, double(half - i - j) / half);
    };
    // Corners u, v, w of a piece in units of 1 / pieces.
    const auto add = [&](glm::ivec2 u, glm::ivec2 v, glm::ivec2 w) {
      const auto sample = [&](int a, int b, int c) {  // a + b + c = 3
        const glm::ivec2 p = a * u + b * v + c * w;
        return at(p.x, p.y);
      };
      const std::array<dvec3, 10> q = {sample(3, 0, 0), sample(2, 1, 0), sample(2, 0, 1), sample(1, 2, 0),
                                       sample(1, 1, 1), sample(1, 0, 2), sample(0, 3, 0), sample(0, 2, 1),
                                       sample(0, 1, 2), sample(0, 0, 3)};
      std::array<dvec3, 10> b = {q[0],
                                 cubicPoint(q[0], q[1], q[3], q[6]),
                                 cubicPoint(q[0], q[2], q[5], q[9]),
                                 cubicPoint(q[6], q[3], q[1], q[0]),
                                 dvec3(0.0),
                                 cubicPoint(q[9], q[5], q[2], q[0]),
                                 q[6],
                                 cubicPoint(q[6], q[7], q[8], q[9]),
                                 cubicPoint(q[9], q[8], q[7], q[6]),
                                 q[9]};
      b[4] = (27.0 * q[4] - (b[0] + b[6] + b[9]) - 3.0 * (b[1] + b[2] + b[3] + b[5] + b[7] + b[8])) / 6.0;
      std::array<glm::dvec4, 10> points;
      for (size_t i = 0; i < 10; ++i) points[i] = glm::dvec4(b[i], 1.0);
      const dvec3 nu = normalAt(2 * u.x, 2 * u.y), nv = normalAt(2 * v.x, 2 * v.y),
                  nw = normalAt(2 * w.x, 2 * w.y);
      const auto between = [&](glm::ivec2 c, glm::ivec2 d, dvec3 nc, dvec3 nd) {
        return 2.0 * normalAt(c.x + d.x, c.y + d.y) - 0.5 * (nc + nd);
      };
      const std::array<dvec3, 6> normals = {nu, between(u, v, nu, nv), between(u, w, nu, nw),
                                            nv, between(v, w, nv, nw), nw};
      addTriangle(set, 3, points, 2, normals);
    };
    for (int i = 0; i < pieces; ++i)
      for (int j = 0; i + j < pieces; ++j) {
        add({i + 1, j}, {i, j + 1}, {i, j});
        if (i + j + 2 <= pieces) add({i, j + 1}, {i + 1, j}, {i + 1, j + 1});
      }
  }
  findNeighbours(set);
  return set;
}

}  // namespace limen::surfaces
