// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/many_lods/sphere_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <thread>

#include "experiments/base/error.h"

namespace limen::many_lods {
namespace {

constexpr double kPi = std::numbers::pi;
/// Half a step of either coordinate of the octahedron moves a direction by less than this.
constexpr double kAxisStep = 1.0 / 16000.0;

struct PointBox {
  glm::dvec3 low{1e300}, high{-1e300};
  void extend(glm::dvec3 point) { low = glm::min(low, point), high = glm::max(high, point); }
  /// Of the sphere around the box, over 4 pi / 3 and 1/8.
  double volume() const {
    const double diagonal = glm::length(high - low);
    return diagonal * diagonal * diagonal;
  }
};

/// Orders a run of points, and all runs below it.
class MedianSplitter {
 public:
  MedianSplitter(const std::vector<glm::dvec3>& points, std::vector<uint32_t>& order)
      : points_(points), order_(order), spare_(order.size()) {}

  void split(size_t first, size_t count, int threadLevels) {
    if (count < 2) return;
    const size_t half = count / 2;
    int best = 0;
    double least = 1e301;
    for (int axis = 0; axis < 3; ++axis) {
      halve(first, count, axis);
      const double volume = boxOf(first, half).volume() + boxOf(first + half, half).volume();
      // Not less: keep what is there; of equal axes the first.
      if (volume < least) {
        least = volume;
        best = axis;
        std::copy_n(order_.begin() + ptrdiff_t(first), count, spare_.begin() + ptrdiff_t(first));
      }
    }
    if (best != 2) std::copy_n(spare_.begin() + ptrdiff_t(first), count, order_.begin() + ptrdiff_t(first));
    if (threadLevels > 0) {
      std::jthread helper([&] { split(first, half, threadLevels - 1); });
      split(first + half, half, threadLevels - 1);
    } else {
      split(first, half, 0);
      split(first + half, half, 0);
    }
  }

 private:
  void halve(size_t first, size_t count, int axis) {
    const auto begin = order_.begin() + ptrdiff_t(first);
    std::nth_element(begin, begin + ptrdiff_t(count / 2), begin + ptrdiff_t(count),
                     [&](uint32_t a, uint32_t b) {
                       const double x = points_[a][axis], y = points_[b][axis];
                       return x < y || (x == y && a < b);
                     });
  }
  PointBox boxOf(size_t first, size_t count) const {
    PointBox box;
    for (size_t i = first; i < first + count; ++i) box.extend(points_[order_[i]]);
    return box;
  }

  const std::vector<glm::dvec3>& points_;
  std::vector<uint32_t>& order_;
  std::vector<uint32_t> spare_;
};

glm::dvec2 folded(glm::dvec3 axis) {
  const double sum = std::abs(axis.x) + std::abs(axis.y) + std::abs(axis.z);
  glm::dvec2 out = glm::dvec2(axis) / sum;
  if (axis.z < 0.0)
    out = {(1.0 - std::abs(out.y)) * (out.x < 0.0 ? -1.0 : 1.0),
           (1.0 - std::abs(out.x)) * (out.y < 0.0 ? -1.0 : 1.0)};
  return out;
}

}  // namespace

NormalCone merged(const NormalCone& a, const NormalCone& b) {
  if (a.halfAngle >= kPi || b.halfAngle >= kPi) return {a.axis, kPi};
  const double between = std::atan2(glm::length(glm::cross(a.axis, b.axis)), glm::dot(a.axis, b.axis));
  const NormalCone &wide = a.halfAngle >= b.halfAngle ? a : b, &narrow = &wide == &a ? b : a;
  if (between + narrow.halfAngle <= wide.halfAngle) return wide;
  const double halfAngle = 0.5 * (between + a.halfAngle + b.halfAngle);
  if (halfAngle >= kPi) return {a.axis, kPi};
  // Turned from a towards b; axes that point apart leave the plane to choose.
  glm::dvec3 side = b.axis - a.axis * glm::dot(a.axis, b.axis);
  if (!(glm::dot(side, side) > 1e-24)) {
    side = glm::cross(a.axis, std::abs(a.axis.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0));
    if (between < 1.0) return {a.axis, halfAngle};
  }
  const double turn = halfAngle - a.halfAngle;
  return {glm::normalize(a.axis * std::cos(turn) + glm::normalize(side) * std::sin(turn)), halfAngle};
}

PackedCone pack(const NormalCone& cone) {
  const glm::dvec2 at = folded(cone.axis);
  const auto whole = [](double x) {
    return static_cast<uint32_t>(std::lround((std::clamp(x, -1.0, 1.0) * 0.5 + 0.5) * 65534.0));
  };
  const double halfAngle = cone.halfAngle > 0.0 || cone.halfAngle == 0.0 ? cone.halfAngle + kAxisStep : kPi;
  return {whole(at.x) | whole(at.y) << 16,
          static_cast<uint32_t>(std::min(std::ceil(halfAngle / kPi * 65535.0), 65535.0))};
}

NormalCone unpack(PackedCone cone) {
  const glm::dvec2 at = glm::dvec2(cone.axis & 0xffffU, cone.axis >> 16) / 32767.0 - 1.0;
  glm::dvec3 axis(at, 1.0 - std::abs(at.x) - std::abs(at.y));
  if (axis.z < 0.0) {
    axis.x = (1.0 - std::abs(at.y)) * (at.x < 0.0 ? -1.0 : 1.0);
    axis.y = (1.0 - std::abs(at.x)) * (at.y < 0.0 ? -1.0 : 1.0);
  }
  return {glm::normalize(axis), cone.halfAngle / 65535.0 * kPi};
}

glm::vec4 mergedSphere(glm::vec4 a, glm::vec4 b) {
  const glm::vec3 ca(a), cb(b);
  const glm::vec3 apart = cb - ca;
  const float distance = std::sqrt(apart.x * apart.x + apart.y * apart.y + apart.z * apart.z);
  // Of a sphere within the other, the other's centre; else so far along that both just touch from within.
  const float along = distance > 0.0F ? 0.5F + (b.w - a.w) / (2.0F * distance) : 0.0F;
  const glm::vec3 centre = ca + apart * std::clamp(along, 0.0F, 1.0F);
  const auto reach = [&](glm::vec3 of, float radius) {
    const glm::vec3 v = of - centre;
    return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z) + radius;
  };
  return {centre, std::max(reach(ca, a.w), reach(cb, b.w)) * (1.0F + kSphereSlack)};
}

void mergeUpwards(SphereTree& tree) {
  // Nodes come after their parents.
  for (auto node = static_cast<uint32_t>(tree.spheres.size()) - 1; node >= kRootNode; --node) {
    uint32_t first = 2 * node;
    if (tree.links.empty()) {
      if (node >= tree.leafCount()) continue;
    } else {
      first = tree.links[node].firstChild;
      if (first == 0) continue;
      tree.links[node].height = 1 + std::max(tree.links[first].height, tree.links[first + 1].height);
    }
    tree.spheres[node] = mergedSphere(tree.spheres[first], tree.spheres[first + 1]);
    NormalCone cone = merged(unpack(tree.cones[first]), unpack(tree.cones[first + 1]));
    cone.halfAngle += kConeSlack;
    tree.cones[node] = pack(cone);
  }
}

void prepareLeaves(SphereTree& tree, const std::vector<glm::dvec3>& positions,
                   const std::vector<glm::uvec3>& triangles, double leafScale) {
  const size_t leaves = tree.leafCount();
  tree.area = surfaceArea(positions, triangles);
  tree.leafRadius = static_cast<float>(leafScale * std::sqrt(tree.area / (kPi * double(leaves))));
  tree.spheres.resize(2 * leaves);
  tree.cones.resize(2 * leaves);
  tree.samples.resize(tree.links.empty() ? leaves : 2 * leaves, {kNoTriangle, 0});
}

void setLeaf(SphereTree& tree, uint32_t node, glm::dvec3 point, uint32_t triangle,
             const std::vector<glm::dvec3>& positions, const std::vector<glm::uvec3>& triangles) {
  tree.spheres[node] = glm::vec4(glm::vec3(point), tree.leafRadius);
  const glm::uvec3 corners = triangles[triangle];
  const glm::dvec3 a = positions[corners.x];
  tree.cones[node] =
      pack({glm::normalize(glm::cross(positions[corners.y] - a, positions[corners.z] - a)), 0.0});
}

SphereTree buildSphereTree(const std::vector<glm::dvec3>& positions, const std::vector<glm::uvec3>& triangles,
                           glm::dvec3 anchor, const TreeBuildSettings& settings) {
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
  int threadLevels = 0;
  while ((1U << threadLevels) < std::max(std::thread::hardware_concurrency(), 1U)) ++threadLevels;
  MedianSplitter(points, order).split(0, leaves, std::min(threadLevels, 8));

  prepareLeaves(tree, positions, triangles, settings.leafScale);
  for (uint32_t i = 0; i < leaves; ++i) {
    tree.samples[i] = samples[order[i]];
    setLeaf(tree, leaves + i, points[order[i]], tree.samples[i].triangle, positions, triangles);
  }
  mergeUpwards(tree);
  return tree;
}

}  // namespace limen::many_lods
