// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/closest_point.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "renderer/scene/shapes.h"

namespace limen::scene {
namespace {

constexpr uint32_t kLeaf = 4;

double squaredDistance(const Bounds& box, glm::dvec3 point) {
  const glm::dvec3 d = glm::max(glm::max(box.low - point, point - box.high), glm::dvec3(0.0));
  return glm::dot(d, d);
}

glm::dvec3 closestOnSegment(glm::dvec3 a, glm::dvec3 b, glm::dvec3 point) {
  const glm::dvec3 along = b - a;
  const double length = glm::dot(along, along);
  const double t = length > 0.0 ? std::clamp(glm::dot(point - a, along) / length, 0.0, 1.0) : 0.0;
  return a + t * along;
}

double oneSided(const Mesh& from, const ClosestPoint& to, int samples, int64_t seed) {
  double largest = 0.0;
  std::vector<uint8_t> used(from.positions.size(), 0);
  for (const glm::uvec3& t : from.triangles)
    for (int corner = 0; corner < 3; ++corner) used[t[corner]] = 1;
  for (size_t i = 0; i < used.size(); ++i)
    if (used[i]) largest = std::max(largest, to.distance(from.positions[i]));
  for (const glm::dvec3& point : pointsOnSurface(from, samples, seed))
    largest = std::max(largest, to.distance(point));
  return largest;
}

}  // namespace

std::vector<glm::dvec3> pointsOnSurface(const Mesh& mesh, int count, int64_t seed) {
  std::vector<double> areas;
  double total = 0.0;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a = mesh.positions[t.x];
    total += 0.5 * glm::length(glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a));
    areas.push_back(total);
  }
  std::vector<glm::dvec3> out;
  if (!(total > 0.0)) return out;
  Random random(seed);
  for (int i = 0; i < count; ++i) {
    // Stratified over the cumulative area, so that no large triangle is missed by chance.
    const double at = total * (i + random.uniform(0.0, 1.0)) / count;
    const auto found = std::upper_bound(areas.begin(), areas.end() - 1, at);
    const glm::uvec3 t = mesh.triangles[static_cast<size_t>(found - areas.begin())];
    const double root = std::sqrt(random.uniform(0.0, 1.0)), v = random.uniform(0.0, 1.0);
    out.push_back((1.0 - root) * mesh.positions[t.x] + root * (1.0 - v) * mesh.positions[t.y] +
                  root * v * mesh.positions[t.z]);
  }
  return out;
}

glm::dvec3 closestOnTriangle(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c, glm::dvec3 point) {
  const glm::dvec3 ab = b - a, ac = c - a, ap = point - a;
  // The foot of the perpendicular in barycentric coordinates, by the normal equations.
  const double d11 = glm::dot(ab, ab), d12 = glm::dot(ab, ac), d22 = glm::dot(ac, ac);
  const double e1 = glm::dot(ap, ab), e2 = glm::dot(ap, ac), determinant = d11 * d22 - d12 * d12;
  if (determinant > 1e-14 * d11 * d22) {
    const double u = (d22 * e1 - d12 * e2) / determinant, v = (d11 * e2 - d12 * e1) / determinant;
    if (u >= 0.0 && v >= 0.0 && u + v <= 1.0) return a + u * ab + v * ac;
  }
  // Outside, or degenerate: the nearest point lies on an edge.
  glm::dvec3 best = closestOnSegment(a, b, point);
  for (const glm::dvec3& other : {closestOnSegment(b, c, point), closestOnSegment(c, a, point)})
    if (glm::dot(other - point, other - point) < glm::dot(best - point, best - point)) best = other;
  return best;
}

ClosestPoint::ClosestPoint(const Mesh& mesh) {
  assert(!mesh.triangles.empty());
  for (const glm::uvec3& t : mesh.triangles)
    triangles_.push_back({mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]});
  nodes_.reserve(triangles_.size());
  build(0, static_cast<uint32_t>(triangles_.size()));
}

void ClosestPoint::build(uint32_t first, uint32_t count) {
  const size_t at = nodes_.size();
  nodes_.emplace_back();
  Bounds bounds, centres;
  for (uint32_t i = first; i < first + count; ++i) {
    const Triangle& t = triangles_[i];
    for (const glm::dvec3& p : {t.a, t.b, t.c}) bounds.extend(p);
    centres.extend(t.a + t.b + t.c);
  }
  nodes_[at].bounds = bounds;
  nodes_[at].first = first;
  if (count <= kLeaf) {
    nodes_[at].count = count;
    return;
  }
  const glm::dvec3 extent = centres.high - centres.low;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  const uint32_t half = count / 2;
  const auto begin = triangles_.begin() + first;
  std::nth_element(begin, begin + half, begin + count, [axis](const Triangle& s, const Triangle& t) {
    return s.a[axis] + s.b[axis] + s.c[axis] < t.a[axis] + t.b[axis] + t.c[axis];
  });
  build(first, half);
  nodes_[at].right = static_cast<uint32_t>(nodes_.size());
  build(first + half, count - half);
}

glm::dvec3 ClosestPoint::operator()(glm::dvec3 point) const {
  glm::dvec3 best = triangles_[0].a;
  double nearest = glm::dot(best - point, best - point);
  std::array<uint32_t, 64> open{};  // halving: no deeper than log2 of the count of triangles
  size_t depth = 1;
  while (depth > 0) {
    const uint32_t at = open[--depth];
    const Node& node = nodes_[at];
    if (squaredDistance(node.bounds, point) >= nearest) continue;
    for (uint32_t i = node.first; i < node.first + node.count; ++i) {
      const glm::dvec3 found = closestOnTriangle(triangles_[i].a, triangles_[i].b, triangles_[i].c, point);
      const double squared = glm::dot(found - point, found - point);
      if (squared < nearest) nearest = squared, best = found;
    }
    if (node.count > 0) continue;
    uint32_t near = at + 1, far = node.right;
    if (squaredDistance(nodes_[far].bounds, point) < squaredDistance(nodes_[near].bounds, point))
      std::swap(near, far);
    open[depth++] = far;
    open[depth++] = near;
  }
  return best;
}

double sampledDeviation(const Mesh& one, const Mesh& other, int samples, int64_t seed) {
  return std::max(oneSided(one, ClosestPoint(other), samples, seed),
                  oneSided(other, ClosestPoint(one), samples, seed + 1));
}

}  // namespace limen::scene
