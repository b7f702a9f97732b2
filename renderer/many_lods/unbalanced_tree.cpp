// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/many_lods/unbalanced_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>

namespace limen::many_lods {
namespace {

constexpr int kPlaces = 64;  // intervals along an axis

struct RunBox {
  glm::dvec3 low{1e300}, high{-1e300};
  void extend(glm::dvec3 point) { low = glm::min(low, point), high = glm::max(high, point); }
  void extend(const RunBox& box) { low = glm::min(low, box.low), high = glm::max(high, box.high); }
  /// Of the sphere around it, but for a factor; 0 if there is none.
  double volume() const { return low.x > high.x ? 0.0 : std::pow(glm::length(high - low), 3.0); }
};

class LeastVolumeSplitter {
 public:
  LeastVolumeSplitter(const std::vector<glm::dvec3>& points, std::vector<uint32_t>& order)
      : points_(points), order_(order) {}

  /// How many points of the run come first.
  size_t split(size_t first, size_t count, int heightLeft) {
    // A run of n points needs log2(n) levels.
    const int needed = static_cast<int>(std::bit_width(count - 1));
    RunBox box;
    for (size_t i = first; i < first + count; ++i) box.extend(points_[order_[i]]);
    int axis = -1;
    double place = 0.0, least = 1e301;
    if (heightLeft > needed)
      for (int candidate = 0; candidate < 3; ++candidate)
        tryAxis(first, count, candidate, box, heightLeft, axis, place, least);
    const auto begin = order_.begin() + ptrdiff_t(first);
    if (axis >= 0) {
      const auto middle = std::partition(begin, begin + ptrdiff_t(count),
                                         [&](uint32_t at) { return intervalOf(at, axis, box) < place; });
      return static_cast<size_t>(middle - begin);
    }
    const glm::dvec3 size = box.high - box.low;
    const int longest = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    std::nth_element(begin, begin + ptrdiff_t(count / 2), begin + ptrdiff_t(count),
                     [&](uint32_t a, uint32_t b) {
                       const double x = points_[a][longest], y = points_[b][longest];
                       return x < y || (x == y && a < b);
                     });
    return count / 2;
  }

 private:
  double intervalOf(uint32_t point, int axis, const RunBox& box) const {
    const double share = (points_[point][axis] - box.low[axis]) / (box.high[axis] - box.low[axis]);
    return std::min(std::floor(share * kPlaces), kPlaces - 1.0);
  }

  void tryAxis(size_t first, size_t count, int axis, const RunBox& box, int heightLeft, int& bestAxis,
               double& place, double& least) const {
    if (!(box.high[axis] > box.low[axis])) return;
    std::array<RunBox, kPlaces> boxes;
    std::array<size_t, kPlaces> counts{};
    for (size_t i = first; i < first + count; ++i) {
      const auto at = static_cast<size_t>(intervalOf(order_[i], axis, box));
      boxes[at].extend(points_[order_[i]]);
      ++counts[at];
    }
    std::array<double, kPlaces> right{};
    RunBox sum;
    for (size_t i = kPlaces - 1; i > 0; --i) {
      sum.extend(boxes[i]);
      right[i] = sum.volume();
    }
    sum = {};
    size_t left = 0;
    for (size_t i = 1; i < kPlaces; ++i) {
      sum.extend(boxes[i - 1]);
      left += counts[i - 1];
      if (left == 0 || left == count) continue;
      // Both sides find room below.
      if (static_cast<int>(std::bit_width(std::max(left, count - left) - 1)) >= heightLeft) continue;
      const double volume = sum.volume() + right[i];
      if (volume < least) least = volume, bestAxis = axis, place = double(i);
    }
  }

  const std::vector<glm::dvec3>& points_;
  std::vector<uint32_t>& order_;
};

}  // namespace

SphereTree buildUnbalancedTree(const std::vector<glm::dvec3>& positions,
                               const std::vector<glm::uvec3>& triangles, glm::dvec3 anchor,
                               const TreeBuildSettings& settings) {
  SphereTree tree;
  tree.depth = settings.depth;
  const uint32_t leaves = tree.leafCount();
  const std::vector<SurfaceSample> samples = sampleSurface(positions, triangles, leaves, settings.seed);
  std::vector<glm::dvec3> points;
  points.reserve(leaves);
  for (const SurfaceSample& sample : samples)
    points.push_back(positionOf(sample, positions, triangles) - anchor);
  std::vector<uint32_t> order(leaves);
  std::iota(order.begin(), order.end(), 0U);

  // Level by level, so that numbers are in the order in which nodes are made.
  struct Run {
    size_t first, count;
  };
  LeastVolumeSplitter splitter(points, order);
  std::vector<Run> runs(size_t{2} * leaves);
  tree.links.assign(size_t{2} * leaves, {});
  runs[kRootNode] = {0, leaves};
  tree.levelFirst = {kRootNode};
  uint32_t next = kRootNode + 1;
  for (uint32_t node = kRootNode; node < next; ++node) {
    if (node == tree.levelFirst.back()) tree.levelFirst.push_back(next);
    const Run run = runs[node];
    tree.links[node].leaves = static_cast<uint32_t>(run.count);
    if (run.count == 1) continue;
    const int level = static_cast<int>(tree.levelFirst.size()) - 2;
    const size_t left = splitter.split(run.first, run.count, kMostTreeHeight - level);
    tree.links[node].firstChild = next;
    tree.links[next].parent = tree.links[next + 1].parent = node;
    runs[next] = {run.first, left};
    runs[next + 1] = {run.first + left, run.count - left};
    next += 2;
  }
  while (tree.levelFirst.size() > 1 && tree.levelFirst.back() >= next) tree.levelFirst.pop_back();
  tree.levelFirst.push_back(next);

  prepareLeaves(tree, positions, triangles, settings.leafScale);
  for (uint32_t node = kRootNode; node < next; ++node)
    if (runs[node].count == 1) {
      const uint32_t point = order[runs[node].first];
      tree.samples[node] = samples[point];
      setLeaf(tree, node, points[point], samples[point].triangle, positions, triangles);
    }
  mergeUpwards(tree);
  return tree;
}

}  // namespace limen::many_lods
