// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/reflections/scene_needs/reflector_facts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <map>
#include <set>
#include <tuple>

#include "renderer/techniques/reflections/planar_mirror/mirror_planes.h"
#include "renderer/techniques/reflections/vertex_reflection/star_mesh.h"

namespace limen::techniques {
namespace {

constexpr double kSameDirectionRad = 1e-3, kFlatRad = 1e-6;
/// As vertex reflection demands it.
constexpr double kLeastCosineOfStar = 1e-4;

struct ReflectorTriangle {
  uint32_t index = 0;  ///< of the scene
  glm::uvec3 corners{0};
  std::array<glm::dvec3, 3> at;
  glm::dvec3 normal{0.0};
  double area = 0.0;
};

std::vector<ReflectorTriangle> trianglesOf(const scene::Scene& scene, const scene::Part& part) {
  std::vector<ReflectorTriangle> out;
  for (uint32_t t = part.firstTriangle; t < part.firstTriangle + part.triangleCount; ++t) {
    const glm::uvec3 of = scene.mesh.triangles[t];
    const std::array<glm::dvec3, 3> at = {scene.mesh.positions[of.x], scene.mesh.positions[of.y],
                                          scene.mesh.positions[of.z]};
    const glm::dvec3 cross = glm::cross(at[1] - at[0], at[2] - at[0]);
    const double length = glm::length(cross);
    if (length > 0.0 && std::isfinite(length)) out.push_back({t, of, at, cross / length, 0.5 * length});
  }
  return out;
}

double angleBetween(glm::dvec3 a, glm::dvec3 b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// The normal with which the corner reflects: the vertex's, if it has one, or the triangle's.
glm::dvec3 normalAt(const scene::Mesh& mesh, const ReflectorTriangle& triangle, int corner) {
  if (mesh.normals.empty()) return triangle.normal;
  const glm::dvec3 normal(mesh.normals[triangle.corners[corner]]);
  const double length = glm::length(normal);
  return length > 0.0 && std::isfinite(length) ? normal / length : triangle.normal;
}

int planesOf(const scene::Mesh& mesh, const std::vector<ReflectorTriangle>& triangles,
             const MirrorPlanes& found) {
  std::set<uint32_t> planes;
  for (const ReflectorTriangle& triangle : triangles) {
    for (int corner = 0; corner < 3; ++corner)
      if (angleBetween(normalAt(mesh, triangle, corner), triangle.normal) > kSameDirectionRad) return 0;
    planes.insert(found.planeOf[triangle.index]);
  }
  return static_cast<int>(planes.size());
}

/// Middle of the box and largest distance of a corner from it.
std::pair<glm::dvec3, double> sphereAround(const std::vector<ReflectorTriangle>& triangles) {
  scene::Bounds bounds;
  for (const ReflectorTriangle& triangle : triangles)
    for (const glm::dvec3& corner : triangle.at) bounds.extend(corner);
  double radius = 0.0;
  for (const ReflectorTriangle& triangle : triangles)
    for (const glm::dvec3& corner : triangle.at)
      radius = std::max(radius, glm::length(corner - bounds.centre()));
  return {bounds.centre(), radius};
}

double nearestOther(const scene::Scene& scene, uint32_t self, glm::dvec3 point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (uint32_t p = 0; p < scene.parts.size(); ++p) {
    if (p == self) continue;
    const scene::Part& part = scene.parts[p];
    for (uint32_t t = part.firstTriangle; t < part.firstTriangle + part.triangleCount; ++t) {
      const glm::uvec3 of = scene.mesh.triangles[t];
      const double distance = distanceToTriangle(point, scene.mesh.positions[of.x],
                                                 scene.mesh.positions[of.y], scene.mesh.positions[of.z]);
      if (distance < nearest) nearest = distance;  // false for what is no number
    }
  }
  return nearest;
}

/// Turns and creases of the edges between two triangles each; corners at one place are one corner.
class Edges {
 public:
  Edges(const scene::Mesh& mesh, const std::vector<ReflectorTriangle>& triangles) : mesh_(mesh) {
    std::map<std::tuple<double, double, double>, uint32_t> places;
    std::map<std::pair<uint32_t, uint32_t>, std::vector<Side>> sides;
    for (const ReflectorTriangle& triangle : triangles) {
      std::array<uint32_t, 3> place{};
      for (size_t i = 0; i < 3; ++i) {
        const glm::dvec3& p = triangle.at[i];
        place[i] = places.try_emplace({p.x, p.y, p.z}, static_cast<uint32_t>(places.size())).first->second;
      }
      for (int i = 0; i < 3; ++i) {
        const uint32_t from = place[size_t(i)], to = place[size_t((i + 1) % 3)];
        const bool turned = from > to;
        sides[std::minmax(from, to)].push_back(
            {&triangle, turned ? (i + 1) % 3 : i, turned ? i : (i + 1) % 3, (i + 2) % 3});
      }
    }
    for (const auto& [ends, both] : sides)
      if (both.size() == 2) add(both[0], both[1]);
  }

  double concaveShare() const { return turn_ > 0.0 ? concave_ / turn_ : 0.0; }
  double creasedShare(double creaseRad) const {
    double all = 0.0, creased = 0.0;
    for (const auto& [length, angle] : jumps_) {
      all += length;
      if (angle > creaseRad) creased += length;
    }
    return all > 0.0 ? creased / all : 0.0;
  }

 private:
  struct Side {
    const ReflectorTriangle* triangle;
    int low, high;  ///< its corners at the edge, in the order of their places
    int opposite;
  };

  void add(const Side& a, const Side& b) {
    const ReflectorTriangle &one = *a.triangle, &other = *b.triangle;
    const glm::dvec3 start = one.at[size_t(a.low)];
    const double length = glm::length(one.at[size_t(a.high)] - start);
    const double turn = angleBetween(one.normal, other.normal);
    if (turn > kFlatRad) {
      turn_ += length * turn;
      if (glm::dot(one.normal, other.at[size_t(b.opposite)] - start) > 0.0) concave_ += length * turn;
    }
    jumps_.emplace_back(length,
                        std::max(angleBetween(normalAt(mesh_, one, a.low), normalAt(mesh_, other, b.low)),
                                 angleBetween(normalAt(mesh_, one, a.high), normalAt(mesh_, other, b.high))));
  }

  const scene::Mesh& mesh_;
  double turn_ = 0.0, concave_ = 0.0;
  std::vector<std::pair<double, double>> jumps_;  ///< length of an edge, angle between its sides' normals
};

}  // namespace

double distanceToTriangle(glm::dvec3 point, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
  const auto toEdge = [&](glm::dvec3 from, glm::dvec3 to) {
    const glm::dvec3 along = to - from;
    const double square = glm::dot(along, along);
    const double at = square > 0.0 ? std::clamp(glm::dot(point - from, along) / square, 0.0, 1.0) : 0.0;
    return glm::length(point - (from + at * along));
  };
  const double toEdges = std::min({toEdge(a, b), toEdge(b, c), toEdge(c, a)});
  const glm::dvec3 cross = glm::cross(b - a, c - a);
  const double area = glm::length(cross);
  if (!(area > 0.0)) return toEdges;
  const glm::dvec3 normal = cross / area;
  const auto isInside = [&](glm::dvec3 from, glm::dvec3 to) {
    return glm::dot(glm::cross(to - from, point - from), normal) >= 0.0;
  };
  return isInside(a, b) && isInside(b, c) && isInside(c, a) ? std::abs(glm::dot(normal, point - a)) : toEdges;
}

std::vector<ReflectorFacts> measureReflectors(const scene::Scene& scene, double creaseDeg) {
  const MirrorPlanes planes =
      findMirrorPlanes(scene, scene.bounds().centre(), std::numeric_limits<int>::max());
  std::vector<ReflectorFacts> out;
  double allArea = 0.0;
  for (uint32_t p = 0; p < scene.parts.size(); ++p) {
    const scene::Part& part = scene.parts[p];
    const scene::Material& material = scene.materials[part.material];
    if (!material.reflects()) continue;
    const std::vector<ReflectorTriangle> triangles = trianglesOf(scene, part);
    if (triangles.empty()) continue;
    ReflectorFacts facts{.part = p, .name = part.name, .glossRad = double(material.glossRad)};
    for (const ReflectorTriangle& triangle : triangles) facts.areaShare += triangle.area;
    allArea += facts.areaShare;
    facts.planes = planesOf(scene.mesh, triangles, planes);
    const auto [middle, radius] = sphereAround(triangles);
    facts.surroundings = nearestOther(scene, p, middle) / radius;
    const reflections::StarCentre centre =
        reflections::findStarCentre(scene.mesh, {part.firstTriangle, part.triangleCount});
    facts.star = centre.leastCosine > kLeastCosineOfStar;
    const Edges edges(scene.mesh, triangles);
    facts.concaveShare = edges.concaveShare();
    facts.creasedShare = edges.creasedShare(glm::radians(creaseDeg));
    out.push_back(std::move(facts));
  }
  for (ReflectorFacts& facts : out) facts.areaShare /= allArea;
  return out;
}

}  // namespace limen::techniques
