// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/curved/figure.h"

#include <algorithm>
#include <cmath>

#include "renderer/surfaces/catmull_clark.h"

namespace limen::scene {
namespace {

using Cell = std::array<int, 3>;

constexpr int kArm = 9, kLeg = 8, kTorso = 6;

/// Unit cubes of the figure.
std::set<Cell> figureCells() {
  std::set<Cell> cells;
  const auto fill = [&](Cell low, Cell high) {
    for (int x = low[0]; x < high[0]; ++x)
      for (int y = low[1]; y < high[1]; ++y)
        for (int z = low[2]; z < high[2]; ++z) cells.insert({x, y, z});
  };
  fill({-2, 0, -1}, {2, kTorso, 1});
  fill({-2, -kLeg, -1}, {-1, 0, 1});
  fill({1, -kLeg, -1}, {2, 0, 1});
  fill({-2 - kArm, kTorso - 2, -1}, {-2, kTorso, 1});
  fill({2, kTorso - 2, -1}, {2 + kArm, kTorso, 1});
  fill({-1, kTorso, -1}, {1, kTorso + 3, 1});
  fill({-2, -kLeg, 1}, {-1, -kLeg + 1, 2});
  fill({1, -kLeg, 1}, {2, -kLeg + 1, 2});
  fill({1, kTorso, 0}, {2, kTorso + 1, 1});  // upon a shoulder
  return cells;
}

/// The cells' surface.
surfaces::PolygonMesh hullOf(const std::set<Cell>& cells) {
  surfaces::PolygonMesh mesh;
  std::map<Cell, uint32_t> vertices;
  const auto vertex = [&](Cell at) {
    const auto [place, added] = vertices.emplace(at, static_cast<uint32_t>(mesh.points.size()));
    if (added) mesh.points.emplace_back(at[0], at[1], at[2]);
    return place->second;
  };
  for (const Cell& cell : cells)
    for (size_t axis = 0; axis < 3; ++axis)
      for (const int step : {-1, 1}) {
        Cell beside = cell;
        beside[axis] += step;
        if (cells.contains(beside)) continue;
        const size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
        Cell corner = cell;
        if (step > 0) ++corner[axis];
        std::array<Cell, 4> corners = {corner, corner, corner, corner};
        ++corners[1][u], ++corners[2][u], ++corners[2][v], ++corners[3][v];
        if (step < 0) std::swap(corners[1], corners[3]);
        std::vector<uint32_t>& face = mesh.faces.emplace_back();
        for (const Cell& at : corners) face.push_back(vertex(at));
      }
  return mesh;
}

/// Rounder and slimmer towards hands and feet, with a head.
glm::dvec3 shaped(glm::dvec3 p) {
  const double out = std::abs(p.x);
  if (p.y > kTorso) {
    const double up = (p.y - kTorso) / 3.0;
    const double wide = up < 0.35 ? 0.8 : 1.35;
    return {p.x * (out < 1.5 ? wide : 1.0), p.y, p.z * wide};
  }
  if (out > 2.0) {
    const double along = (out - 2.0) / kArm, slim = 0.85 - 0.35 * along + (along > 0.85 ? 0.2 : 0.0);
    const double middle = kTorso - 1.0;
    return {p.x * 0.8, middle + (p.y - middle) * slim - 0.8 * along * along, p.z * slim};
  }
  if (p.y < 0.0) {
    const double down = -p.y / kLeg, slim = 1.1 - 0.3 * down;
    const double middle = p.x < 0.0 ? -1.5 : 1.5;
    return {middle * (1.0 + 0.35 * down) + (p.x - middle) * 1.4 * slim, p.y, p.z * slim};
  }
  const double belly = 1.0 + 0.3 * std::sin(M_PI * p.y / kTorso);
  return {p.x * belly, p.y, p.z * belly * 1.15};
}

/// Joints of hips, shoulders and neck, in the coordinates of shaped().
void addJoints(surfaces::SubdivisionSurface& surface) {
  surface.joints = {{{-2.0, kTorso - 1.0, 0.0}, {0.0, 0.0, 1.0}, 0.7, 1.0, 0.0},
                    {{2.0, kTorso - 1.0, 0.0}, {0.0, 0.0, 1.0}, 0.7, 1.0, 0.8},
                    {{-1.5, 0.0, 0.0}, {1.0, 0.0, 0.0}, 0.5, 1.0, 0.0},
                    {{1.5, 0.0, 0.0}, {1.0, 0.0, 0.0}, 0.5, 1.0, M_PI},
                    {{0.0, kTorso, 0.0}, {0.0, 1.0, 0.0}, 0.6, 2.0, 0.0}};
  const auto ramp = [](double x) {
    x = std::clamp(x, 0.0, 1.0);
    return x * x * (3.0 - 2.0 * x);
  };
  for (const glm::dvec3& p : surface.cage.points) {
    surfaces::JointBinding binding;
    if (p.y > kTorso + 0.2 && std::abs(p.x) < 1.9)
      binding = {4, float(ramp((p.y - kTorso) / 1.2))};
    else if (std::abs(p.x) > 2.0 && p.y > 1.5)
      binding = {p.x < 0.0 ? 0U : 1U, float(ramp((std::abs(p.x) - 2.0) / 2.0))};
    else if (p.y < 0.0)
      binding = {p.x < 0.0 ? 2U : 3U, float(ramp(-p.y / 2.0))};
    surface.bindings.push_back(binding);
  }
}

/// Onto the ground, 1 high.
void place(surfaces::SubdivisionSurface& surface) {
  double low = 1e300, high = -1e300;
  for (const glm::dvec3& p : surface.cage.points) low = std::min(low, p.y), high = std::max(high, p.y);
  const double scale = 1.0 / (high - low);
  const auto put = [&](glm::dvec3 p) { return scale * (p - glm::dvec3(0.0, low, 0.0)); };
  for (glm::dvec3& p : surface.cage.points) p = put(p);
  for (surfaces::Joint& joint : surface.joints) joint.pivot = put(joint.pivot);
}

}  // namespace

surfaces::SubdivisionSurface figureOfQuads() {
  surfaces::SubdivisionSurface out;
  out.scheme = surfaces::SubdivisionScheme::CatmullClark;
  out.cage = surfaces::catmullClark(hullOf(figureCells()));
  for (glm::dvec3& p : out.cage.points) p = shaped(p);
  addJoints(out);
  place(out);
  return out;
}

surfaces::SubdivisionSurface figureOfTriangles() {
  surfaces::SubdivisionSurface out = figureOfQuads();
  out.scheme = surfaces::SubdivisionScheme::Loop;
  std::vector<uint32_t> valence(out.cage.points.size());
  for (const auto& face : out.cage.faces)
    for (const uint32_t v : face) ++valence[v];
  const std::vector<uint32_t> ofQuads = valence;
  // Vertices of three edges keep them unless others would get eight; elsewhere diagonals go where there are
  // fewest edges, in a few rounds.
  std::vector<size_t> first(out.cage.faces.size(), 2);
  for (int round = 0; round < 8; ++round)
    for (size_t f = 0; f < out.cage.faces.size(); ++f) {
      const std::vector<uint32_t>& q = out.cage.faces[f];
      if (first[f] < 2) --valence[q[first[f]]], --valence[q[first[f] + 2]];
      const auto cost = [&](uint32_t a, uint32_t b) {
        return (1U << 2 * valence[a]) + (1U << 2 * valence[b]) +
               (std::min(ofQuads[a], ofQuads[b]) == 3 ? 8192U : 0U);
      };
      const uint32_t straight = cost(q[0], q[2]), other = cost(q[1], q[3]);
      first[f] = straight < other || (straight == other && f % 2 == 0) ? 0 : 1;
      ++valence[q[first[f]]], ++valence[q[first[f] + 2]];
    }
  std::vector<std::vector<uint32_t>> triangles;
  for (size_t f = 0; f < out.cage.faces.size(); ++f) {
    const std::vector<uint32_t>& q = out.cage.faces[f];
    triangles.push_back({q[first[f]], q[first[f] + 1], q[first[f] + 2]});
    triangles.push_back({q[first[f]], q[first[f] + 2], q[(first[f] + 3) % 4]});
  }
  out.cage.faces = std::move(triangles);
  return out;
}

}  // namespace limen::scene
