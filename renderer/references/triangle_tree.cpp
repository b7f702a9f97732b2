// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/references/triangle_tree.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace limen::references {
namespace {

constexpr uint32_t kLeafTriangles = 4;
constexpr size_t kDeepest = 64;  // halving 2^32 triangles takes 32 levels

/// Distances at which the ray is within a box; empty if first > last. A ray in the plane of a side is inside.
struct Span {
  double first, last;
};

Span spanOf(glm::dvec3 origin, glm::dvec3 direction, glm::dvec3 low, glm::dvec3 high, double far) {
  Span span{0.0, far};
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0.0) {
      if (origin[axis] < low[axis] || origin[axis] > high[axis]) return {1.0, 0.0};
      continue;
    }
    double enter = (low[axis] - origin[axis]) / direction[axis],
           leave = (high[axis] - origin[axis]) / direction[axis];
    if (enter > leave) std::swap(enter, leave);
    // Both quotients are rounded.
    const double slack = 1e-14 * (std::abs(enter) + std::abs(leave));
    span.first = std::max(span.first, enter - slack);
    span.last = std::min(span.last, leave + slack);
  }
  return span;
}

}  // namespace

TriangleTree::TriangleTree(const Triangles& triangles) : triangles_(triangles) {
  std::vector<Box> boxes(triangles.count());
  for (uint32_t i = 0; i < triangles.count(); ++i) {
    bool finite = true;
    for (int corner = 0; corner < 3; ++corner) {
      const glm::dvec3 at = triangles.corner(i, corner);
      for (int axis = 0; axis < 3; ++axis) finite = finite && std::isfinite(at[axis]);
      boxes[i].low = glm::min(boxes[i].low, at);
      boxes[i].high = glm::max(boxes[i].high, at);
    }
    if (finite) order_.push_back(i);
  }
  if (order_.empty()) return;
  nodes_.push_back({{}, 0, static_cast<uint32_t>(order_.size())});
  for (size_t node = 0; node < nodes_.size(); ++node) split(node, boxes);
}

void TriangleTree::split(size_t node, std::vector<Box>& boxes) {
  const uint32_t first = nodes_[node].first, count = nodes_[node].count;
  Box box, middles;
  for (uint32_t i = first; i < first + count; ++i) {
    const Box& of = boxes[order_[i]];
    box.low = glm::min(box.low, of.low), box.high = glm::max(box.high, of.high);
    const glm::dvec3 middle = 0.5 * (of.low + of.high);
    middles.low = glm::min(middles.low, middle), middles.high = glm::max(middles.high, middle);
  }
  nodes_[node].box = box;
  if (count <= kLeafTriangles) return;
  const glm::dvec3 size = middles.high - middles.low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const uint32_t half = count / 2;
  const auto begin = order_.begin() + first;
  std::nth_element(begin, begin + half, begin + count, [&](uint32_t a, uint32_t b) {
    const double at = boxes[a].low[axis] + boxes[a].high[axis],
                 other = boxes[b].low[axis] + boxes[b].high[axis];
    return at < other || (at == other && a < b);
  });
  const auto children = static_cast<uint32_t>(nodes_.size());
  nodes_.push_back({{}, first, half});
  nodes_.push_back({{}, first + half, count - half});
  nodes_[node].first = children;
  nodes_[node].count = 0;
}

// Volumes that the ray spans with each edge: of one sign where it passes through the triangle.
void TriangleTree::test(const ExactRay& ray, uint32_t triangle, ExactHit& hit) const {
  if (triangle == ray.from) return;
  const glm::dvec3 a = triangles_.corner(triangle, 0) - ray.origin,
                   b = triangles_.corner(triangle, 1) - ray.origin,
                   c = triangles_.corner(triangle, 2) - ray.origin;
  const double u = glm::dot(ray.direction, glm::cross(c, b)), v = glm::dot(ray.direction, glm::cross(a, c)),
               w = glm::dot(ray.direction, glm::cross(b, a));
  if (!((u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0))) return;
  const double sum = u + v + w;
  const glm::dvec3 n = glm::cross(b - a, c - a);
  const double along = glm::dot(n, ray.direction), area = glm::length(n);
  if (sum == 0.0 || along == 0.0 || !(area > 0.0)) return;
  const double toPlane = glm::dot(n, a);
  if (ray.from != ExactRay::kNoTriangle && !(std::abs(toPlane) > triangles_.planeTolerance() * area)) return;
  const double t = toPlane / along;
  if (!(t > 0.0 && t < ray.far) || t > hit.t || (t == hit.t && triangle > hit.triangle)) return;
  hit = {triangle, t, glm::dvec3(u, v, w) / sum};
}

bool TriangleTree::trace(const ExactRay& ray, bool anyIsEnough, ExactHit& hit) const {
  hit = {ExactRay::kNoTriangle, ray.far, {}};
  if (nodes_.empty()) return false;
  struct Waiting {
    uint32_t node;
    double at;
  };
  std::array<Waiting, kDeepest> stack;
  size_t depth = 0;
  const auto push = [&](uint32_t node) {
    const Box& box = nodes_[node].box;
    const Span span = spanOf(ray.origin, ray.direction, box.low, box.high, hit.t);
    if (span.first <= span.last) stack[depth++] = {node, span.first};
  };
  push(0);
  while (depth > 0) {
    const Waiting next = stack[--depth];
    if (next.at > hit.t) continue;
    const Node& node = nodes_[next.node];
    if (node.count == 0) {
      const size_t before = depth;
      push(node.first);
      push(node.first + 1);
      if (depth == before + 2 && stack[before].at < stack[before + 1].at)
        std::swap(stack[before], stack[before + 1]);
      continue;
    }
    for (uint32_t i = node.first; i < node.first + node.count; ++i) test(ray, order_[i], hit);
    if (anyIsEnough && hit.triangle != ExactRay::kNoTriangle) return true;
  }
  return hit.triangle != ExactRay::kNoTriangle;
}

ExactHit TriangleTree::nearest(const ExactRay& ray) const {
  ExactHit hit;
  trace(ray, false, hit);
  return hit;
}

bool TriangleTree::any(const ExactRay& ray) const {
  ExactHit hit;
  return trace(ray, true, hit);
}

}  // namespace limen::references
