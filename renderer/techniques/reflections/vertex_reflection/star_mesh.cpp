// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/reflections/vertex_reflection/star_mesh.h"

#include <algorithm>
#include <cmath>

namespace limen::reflections {
namespace {

struct Facet {
  std::array<glm::dvec3, 3> corners;
  glm::dvec3 normal;
};

std::vector<Facet> facetsOf(const scene::Mesh& mesh, scene::TriangleRange range) {
  std::vector<Facet> out;
  for (uint32_t i = range.first; i < range.first + range.count; ++i) {
    const glm::uvec3& t = mesh.triangles[i];
    const std::array<glm::dvec3, 3> p = {mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]};
    const glm::dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
    const double length = glm::length(normal);
    if (length > 0.0 && std::isfinite(length)) out.push_back({p, normal / length});
  }
  return out;
}

StarCentre judged(const std::vector<Facet>& facets, glm::dvec3 centre) {
  StarCentre out{.position = centre, .leastCosine = 1.0};
  double sum = 0.0, least = 1.0, most = -1.0;
  for (const Facet& facet : facets)
    for (const glm::dvec3& corner : facet.corners) {
      const double distance = glm::length(corner - centre);
      const double cosine = distance > 0.0 ? glm::dot(facet.normal, corner - centre) / distance : 0.0;
      least = std::min(least, cosine);
      most = std::max(most, cosine);
      sum += distance;
    }
  out.inside = -most > least;
  out.leastCosine = out.inside ? -most : least;
  out.meanRadius = sum / (3.0 * std::max<size_t>(facets.size(), 1));
  return out;
}

/// Middle of the sphere that fits the corners best: |p|^2 = 2 c.p + d, by normal equations around `origin`.
glm::dvec3 fittedCentre(const std::vector<Facet>& facets, glm::dvec3 origin) {
  glm::dmat4 matrix(0.0);
  glm::dvec4 right(0.0);
  for (const Facet& facet : facets)
    for (const glm::dvec3& corner : facet.corners) {
      const glm::dvec4 row(corner - origin, 1.0);
      for (int i = 0; i < 4; ++i) matrix[i] += row[i] * row;
      right += glm::dot(corner - origin, corner - origin) * row;
    }
  if (std::abs(glm::determinant(matrix)) < 1e-30) return origin;
  return origin + 0.5 * glm::dvec3(glm::inverse(matrix) * right);
}

int axisOf(int face) { return face / 2; }

}  // namespace

CubePlace cubePlace(glm::dvec3 d) {
  const glm::dvec3 a = glm::abs(d);
  if (a.x >= a.y && a.x >= a.z)
    return d.x > 0.0 ? CubePlace{0, -d.z / a.x, -d.y / a.x} : CubePlace{1, d.z / a.x, -d.y / a.x};
  if (a.y >= a.z) return d.y > 0.0 ? CubePlace{2, d.x / a.y, d.z / a.y} : CubePlace{3, d.x / a.y, -d.z / a.y};
  return d.z > 0.0 ? CubePlace{4, d.x / a.z, -d.y / a.z} : CubePlace{5, -d.x / a.z, -d.y / a.z};
}

glm::dvec3 cubeDirection(const CubePlace& at) {
  switch (at.face) {
    case 0:
      return {1.0, -at.t, -at.s};
    case 1:
      return {-1.0, -at.t, at.s};
    case 2:
      return {at.s, 1.0, at.t};
    case 3:
      return {at.s, -1.0, -at.t};
    case 4:
      return {at.s, -at.t, 1.0};
    default:
      return {-at.s, -at.t, -1.0};
  }
}

StarCentre findStarCentre(const scene::Mesh& mesh, scene::TriangleRange triangles) {
  const std::vector<Facet> facets = facetsOf(mesh, triangles);
  if (facets.empty()) return {};
  scene::Bounds bounds;
  for (const Facet& facet : facets)
    for (const glm::dvec3& corner : facet.corners) bounds.extend(corner);
  StarCentre best = judged(facets, bounds.centre());
  const StarCentre fitted = judged(facets, fittedCentre(facets, bounds.centre()));
  if (fitted.leastCosine > best.leastCosine) best = fitted;
  // Towards the centre that sees every facet least obliquely, in ever smaller steps.
  for (double step = 0.25 * bounds.diagonal(); best.leastCosine < 0.2 && step > 1e-3 * bounds.diagonal();
       step *= 0.7)
    for (int axis = 0; axis < 3; ++axis)
      for (const double sign : {-1.0, 1.0}) {
        glm::dvec3 offset(0.0);
        offset[axis] = sign * step;
        const StarCentre moved = judged(facets, best.position + offset);
        if (moved.leastCosine > best.leastCosine) best = moved;
      }
  return best;
}

StarMesh::StarMesh(const scene::Mesh& mesh, scene::TriangleRange range, glm::dvec3 centre)
    : cells_(size_t{6} * kCells * kCells) {
  const auto cellOf = [](double s) {
    return std::clamp(static_cast<int>(std::floor(0.5 * (s + 1.0) * kCells)), 0, kCells - 1);
  };
  for (uint32_t i = range.first; i < range.first + range.count; ++i) {
    std::array<Corner, 3> corners;
    const glm::dvec3 a = mesh.positions[mesh.triangles[i].x], b = mesh.positions[mesh.triangles[i].y],
                     c = mesh.positions[mesh.triangles[i].z];
    const glm::dvec3 flat = glm::cross(b - a, c - a);
    const double area = glm::length(flat);
    if (!(area > 0.0) || !std::isfinite(area)) continue;
    for (int k = 0; k < 3; ++k) {
      const uint32_t vertex = mesh.triangles[i][k];
      glm::dvec3 normal(0.0);
      if (!mesh.normals.empty()) normal = mesh.normals[vertex];
      corners[static_cast<size_t>(k)] = {mesh.positions[vertex] - centre, normal};
    }
    if (std::any_of(corners.begin(), corners.end(),
                    [](const Corner& at) { return at.normal == glm::dvec3(0.0); }))
      for (Corner& corner : corners) corner.normal = flat / area;
    const auto number = static_cast<uint32_t>(triangles_.size());
    triangles_.push_back(corners);
    for (int face = 0; face < 6; ++face) {
      const int axis = axisOf(face);
      const double sign = face % 2 == 0 ? 1.0 : -1.0;
      int ahead = 0;
      glm::dvec2 low(1.0), high(-1.0);
      for (const Corner& corner : corners) {
        const double w = sign * corner.position[axis];
        if (!(w > 0.0)) continue;
        ++ahead;
        // On the plane of the face, where a cube place cannot be asked for directly.
        const glm::dvec3 p = corner.position / w;
        CubePlace at{face, 0.0, 0.0};
        const glm::dvec3 alongS = cubeDirection({face, 1.0, 0.0}) - cubeDirection(at);
        const glm::dvec3 alongT = cubeDirection({face, 0.0, 1.0}) - cubeDirection(at);
        const glm::dvec2 st(glm::dot(p, alongS), glm::dot(p, alongT));
        low = glm::min(low, st);
        high = glm::max(high, st);
      }
      if (ahead == 0) continue;
      if (ahead < 3) low = glm::dvec2(-1.0), high = glm::dvec2(1.0);
      constexpr double kMargin = 1e-6;
      if (low.x > 1.0 + kMargin || low.y > 1.0 + kMargin || high.x < -1.0 - kMargin ||
          high.y < -1.0 - kMargin)
        continue;
      for (int y = cellOf(low.y - kMargin); y <= cellOf(high.y + kMargin); ++y)
        for (int x = cellOf(low.x - kMargin); x <= cellOf(high.x + kMargin); ++x)
          cells_[(static_cast<size_t>(face) * kCells + y) * kCells + x].push_back(number);
    }
  }
}

RadialPoint StarMesh::at(glm::dvec3 direction) const {
  const CubePlace place = cubePlace(direction);
  const auto cell = [](double s) {
    return static_cast<size_t>(
        std::clamp(static_cast<int>(std::floor(0.5 * (s + 1.0) * kCells)), 0, kCells - 1));
  };
  double nearest = HUGE_VAL;
  glm::dvec3 normal(0.0);
  for (const uint32_t number :
       cells_[(static_cast<size_t>(place.face) * kCells + cell(place.t)) * kCells + cell(place.s)]) {
    const auto& [a, b, c] = triangles_[number];
    const glm::dvec3 e1 = b.position - a.position, e2 = c.position - a.position, flat = glm::cross(e1, e2);
    const double along = glm::dot(flat, direction);
    if (along == 0.0) continue;
    const double distance = glm::dot(flat, a.position) / along;
    if (!(distance > 0.0) || distance >= nearest) continue;
    const glm::dvec3 p = distance * direction - a.position;
    const double area = glm::dot(flat, flat);
    const double v = glm::dot(glm::cross(p, e2), flat) / area, w = glm::dot(glm::cross(e1, p), flat) / area;
    constexpr double kEdge = -1e-9;  // rays through edges must not pass between two triangles
    if (v < kEdge || w < kEdge || 1.0 - v - w < kEdge) continue;
    nearest = distance;
    normal = (1.0 - v - w) * a.normal + v * b.normal + w * c.normal;
  }
  if (nearest == HUGE_VAL) return {};
  const double length = glm::length(normal);
  return length > 0.0 ? radialPointOfNormal(direction, nearest, normal / length) : RadialPoint{};
}

StarSurface StarMesh::surface(std::shared_ptr<const StarMesh> mesh) {
  return [mesh = std::move(mesh)](glm::dvec3 direction) { return mesh->at(direction); };
}

}  // namespace limen::reflections
