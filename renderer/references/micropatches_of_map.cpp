// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/references/micropatches_of_map.h"

#include <algorithm>
#include <cmath>

namespace limen::references {

MicropatchesOfMap::MicropatchesOfMap(const Image& depths, const frame::LightFrustum& frustum,
                                     glm::dvec2 lightSize, int level, const BlockingRule& rule,
                                     PatchStretch stretch)
    : side_(std::max(depths.width >> level, 1)),
      level_(level),
      depths_(static_cast<size_t>(side_) * static_cast<size_t>(side_), 1e300),
      frustum_(frustum),
      texel_((frustum.high - frustum.low) / double(side_)),
      lightSize_(lightSize),
      rule_(rule),
      stretch_(stretch) {
  for (int y = 0; y < depths.height; ++y)
    for (int x = 0; x < depths.width; ++x) {
      double& coarse = depths_[static_cast<size_t>(y >> level) * static_cast<size_t>(side_) +
                               static_cast<size_t>(x >> level)];
      coarse = std::min(coarse, double(depths.at(x, y)));
      nearest_ = std::min(nearest_, coarse);
    }
}

/// The rule as it applies to one receiver.
struct MicropatchesOfMap::Test {
  const MicropatchesOfMap& map;
  glm::dvec3 normal;
  double limit;       ///< of depth
  double planeLimit;  ///< of depth as a share of the plane's
  double height;      ///< n.p

  Test(const MicropatchesOfMap& of, const PatchReceiver& receiver)
      : map(of), normal(receiver.normal), height(glm::dot(receiver.normal, receiver.position)) {
    const BlockingRule& rule = map.rule_;
    const double z = receiver.position.z;
    // The plane meets the ray along (u, v, 1) at z(u, v) = n.p / n.(u, v, 1). At p its relative change per
    // tangent is -n.x z / n.p along u, and likewise along v.
    const glm::dvec2 change = glm::abs(glm::dvec2(normal)) * (z / std::abs(height));
    const glm::dvec2 finest = map.texel_ / std::exp2(map.level_);
    const double widest = std::max(finest.x, finest.y);
    limit = z * (1.0 - rule.constant);
    if (!rule.plane)
      limit -= rule.slope * std::min(z * (change.x + change.y), rule.maxSlope * z) * widest *
               std::exp2(map.level_);
    // A coarse texel's depth may have been found anywhere in it.
    const double texels = rule.slope + 0.5 * (std::exp2(map.level_) - 1.0);
    planeLimit = 1.0 - rule.constant - texels * std::min(glm::dot(change, finest), rule.maxSlope * widest);
  }

  bool blocks(int x, int y) const {
    if (x < 0 || y < 0) return false;
    const double z = map.depth(x, y);
    if (!(z < limit)) return false;
    if (!map.rule_.plane) return true;
    const glm::dvec3 along(map.tangent(glm::dvec2(x, y) + 0.5), 1.0);
    return z * glm::dot(normal, along) / height < planeLimit;
  }
};

void MicropatchesOfMap::gather(const PatchReceiver& receiver, RectangleUnion& hidden) const {
  const glm::dvec3 p = receiver.position;
  const Test test(*this, receiver);
  if (nearest_ >= test.limit) return;
  // The pyramid over the light with its tip in the receiver narrows with depth: at the nearest depth of all
  // it holds whatever may hide the light. A texel more on each side, for those stretched into it.
  const glm::dvec2 middle = glm::dvec2(p) / p.z, reach = 0.5 * lightSize_ * (1.0 / nearest_ - 1.0 / p.z);
  const glm::dvec2 last(side_ - 1);
  const glm::ivec2 low(
      glm::clamp(glm::floor((middle - reach - frustum_.low) / texel_) - 1.0, glm::dvec2(0.0), last + 1.0));
  const glm::ivec2 high(
      glm::clamp(glm::floor((middle + reach - frustum_.low) / texel_) + 1.0, glm::dvec2(-1.0), last));
  // Where the ray from p through the point of the map at texel coordinates `at` and depth z meets the light.
  const auto onLight = [&](glm::dvec2 at, double z) {
    const glm::dvec2 from(p), towards = tangent(at) * z - from;
    return (from + towards * (p.z / (p.z - z))) / lightSize_ + 0.5;
  };
  for (int y = low.y; y <= high.y; ++y)
    for (int x = low.x; x <= high.x; ++x) {
      if (!test.blocks(x, y)) continue;
      const double z = depth(x, y);
      const glm::dvec2 corner(x, y);
      glm::dvec2 start = onLight(corner, z);
      const glm::dvec2 end = onLight(corner + 1.0, z);
      if (stretch_ != PatchStretch::None) {
        if (test.blocks(x - 1, y)) start.x = std::min(start.x, onLight(corner, depth(x - 1, y)).x);
        if (test.blocks(x, y - 1)) start.y = std::min(start.y, onLight(corner, depth(x, y - 1)).y);
      }
      if (stretch_ == PatchStretch::Diagonal && test.blocks(x - 1, y - 1))
        start = glm::min(start, onLight(corner, depth(x - 1, y - 1)));
      hidden.add(glm::clamp(start, 0.0, 1.0), glm::clamp(end, 0.0, 1.0));
    }
}

HalfPlane MicropatchesOfMap::litSide(const PatchReceiver& receiver) const {
  // n.(l - p) > 0 for points l of the light's plane z = 0.
  const glm::dvec2 n = glm::dvec2(receiver.normal) * lightSize_;
  const double offset = -glm::dot(receiver.normal, receiver.position) - 0.5 * (n.x + n.y);
  const double length = glm::length(n);
  // Parallel to the light: all of it is on one side.
  if (!(length > 0.0)) return {{1.0, 0.0}, 2.0};
  return {n / length, offset / length};
}

double MicropatchesOfMap::visibility(const PatchReceiver& receiver, RectangleUnion& scratch) const {
  scratch.clear();
  gather(receiver, scratch);
  if (!rule_.plane) return std::clamp(1.0 - scratch.area(), 0.0, 1.0);
  const HalfPlane lit = litSide(receiver);
  ConvexPolygon seen, behind;
  split({{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}, lit, seen, behind);
  const double hidden = behind.empty() ? scratch.area() : scratch.area(lit);
  return std::clamp(seen.area() - hidden, 0.0, 1.0);
}

}  // namespace limen::references
