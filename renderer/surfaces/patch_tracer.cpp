// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/patch_tracer.h"

#include <algorithm>

#include "renderer/surfaces/patch_convert.h"

namespace limen::surfaces {
namespace {

using glm::dvec3;

/// Distance at which a ray enters a box grown by `margin`; none if it does not.
std::optional<double> entry(const Ray& ray, dvec3 low, dvec3 high, double margin) {
  double from = 0.0, to = 1e300;
  for (int axis = 0; axis < 3; ++axis) {
    const double inverse = 1.0 / ray.direction[axis];
    double a = (low[axis] - margin - ray.origin[axis]) * inverse,
           b = (high[axis] + margin - ray.origin[axis]) * inverse;
    if (a > b) std::swap(a, b);
    // A NaN, where the ray lies in the box's face, restricts nothing.
    if (a > from) from = a;
    if (b < to) to = b;
  }
  if (from > to) return std::nullopt;
  return from;
}

}  // namespace

PatchTracer::PatchTracer(const PatchSet& set, RootFinder finder) : PatchTracer(set, finder, TrimTest(set)) {}

PatchTracer::PatchTracer(const PatchSet& set, RootFinder finder, TrimTest trims)
    : set_(set), finder_(finder), trims_(std::move(trims)) {
  for (uint32_t i = 0; i < set.patches.size(); ++i) {
    const Patch& patch = set.patches[i];
    dvec3 low(1e300), high(-1e300);
    for (uint32_t p = 0; p < static_cast<uint32_t>(patch.points()); ++p) {
      const glm::dvec4& point = set.points[patch.firstPoint + p];
      low = glm::min(low, dvec3(point) / point.w), high = glm::max(high, dvec3(point) / point.w);
    }
    low_.push_back(low), high_.push_back(high);
    order_.push_back(i);
    searched_.push_back(finder == RootFinder::Clipping && patch.domain == Domain::Triangle
                            ? triangleAsRectangle(set, patch, rectangles_)
                            : patch);
  }
  if (!order_.empty()) build(0, static_cast<uint32_t>(order_.size()));
}

uint32_t PatchTracer::build(uint32_t first, uint32_t count) {
  const auto number = static_cast<uint32_t>(nodes_.size());
  nodes_.emplace_back();
  Node node{dvec3(1e300), dvec3(-1e300), first, count, 0};
  dvec3 low(1e300), high(-1e300);  // of the middles
  for (uint32_t i = first; i < first + count; ++i) {
    const uint32_t patch = order_[i];
    node.low = glm::min(node.low, low_[patch]), node.high = glm::max(node.high, high_[patch]);
    const dvec3 middle = low_[patch] + high_[patch];
    low = glm::min(low, middle), high = glm::max(high, middle);
  }
  if (count > 2) {
    const dvec3 extent = high - low;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    const auto begin = order_.begin() + first;
    std::nth_element(begin, begin + count / 2, begin + count, [&](uint32_t a, uint32_t b) {
      return low_[a][axis] + high_[a][axis] < low_[b][axis] + high_[b][axis];
    });
    build(first, count / 2);
    node.right = build(first + count / 2, count - count / 2);
    node.count = 0;
  }
  nodes_[number] = node;
  return number;
}

std::optional<PatchHit> PatchTracer::nearest(const Ray& ray, double tolerance, RootCounts* counts) const {
  std::optional<PatchHit> best;
  if (nodes_.empty()) return best;
  std::vector<uint32_t> stack = {0};
  while (!stack.empty()) {
    const uint32_t number = stack.back();
    const Node& node = nodes_[number];
    stack.pop_back();
    const std::optional<double> from = entry(ray, node.low, node.high, tolerance);
    if (!from || (best && *from > best->t)) continue;
    if (node.count == 0) {
      stack.push_back(node.right);
      stack.push_back(number + 1);
      continue;
    }
    for (uint32_t i = node.first; i < node.first + node.count; ++i) {
      const uint32_t patch = order_[i];
      const std::optional<double> enters = entry(ray, low_[patch], high_[patch], tolerance);
      if (!enters || (best && *enters > best->t)) continue;
      const Patch& searched = searched_[patch];
      const bool converted = searched.domain != set_.patches[patch].domain;
      const PatchOnRay local = onRay(converted ? rectangles_ : set_, searched, ray);
      const std::vector<RayRoot> roots = finder_ == RootFinder::Hulls ? hullRoots(local, tolerance, counts)
                                         : finder_ == RootFinder::Intervals
                                             ? intervalRoots(local, tolerance, counts)
                                             : clippedRoots(local, tolerance, {}, counts);
      const auto root = std::ranges::find_if(
          roots, [&](const RayRoot& candidate) { return trims_.isLeft(patch, candidate.at); });
      if (root == roots.end() || (best && root->t >= best->t)) continue;
      best = {root->t, patch, root->at};
      // A triangle's u and v of the rectangle's x and y: see triangleAsRectangle().
      if (converted) best->at = trianglePoint(best->at.u * best->at.restV, best->at.v);
    }
  }
  return best;
}

}  // namespace limen::surfaces
