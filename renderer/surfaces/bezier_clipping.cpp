// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <optional>

#include "renderer/surfaces/blossom.h"
#include "renderer/surfaces/ray_roots.h"

namespace limen::surfaces {
namespace {

using glm::dvec2;
using glm::dvec4;

struct ClipRange {
  double low = 0.0, high = 1.0;
};

/// Where the hull of the points (i / n, bottom[i]) and (i / n, top[i]) meets zero; none if nowhere.
std::optional<ClipRange> hullCrossing(int n, std::span<const double> bottom, std::span<const double> top,
                                      double rounding) {
  ClipRange out{2.0, -1.0};
  const auto add = [&](double t) { out.low = std::min(out.low, t), out.high = std::max(out.high, t); };
  for (int i = 0; i <= n; ++i) {
    const auto at = static_cast<size_t>(i);
    if (bottom[at] <= rounding && top[at] >= -rounding) add(double(i) / n);
    for (int k = 0; k <= n; ++k)  // from a point below to one above
      for (const double a : {bottom[at] - rounding, top[at] - rounding})
        for (const double b :
             {bottom[static_cast<size_t>(k)] + rounding, top[static_cast<size_t>(k)] + rounding})
          if (a < 0.0 && b > 0.0) add((i + (k - i) * (a / (a - b))) / n);
  }
  if (out.high < out.low) return std::nullopt;
  return out;
}

class Clipping {
 public:
  Clipping(const PatchOnRay& patch, double tolerance, const ClipSettings& settings, RootCounts& counts)
      : patch_(patch), tolerance_(tolerance), settings_(settings), counts_(counts) {
    for (const dvec4& p : patch.points) largest_ = std::max({largest_, std::abs(p.x), std::abs(p.y)});
  }

  std::vector<RayRoot> run() {
    std::vector<RectanglePart> stack = {RectanglePart{}};
    while (!stack.empty()) {
      RectanglePart part = stack.back();
      stack.pop_back();
      follow(part, stack);
    }
    std::sort(roots_.begin(), roots_.end(), [](const RayRoot& a, const RayRoot& b) { return a.t < b.t; });
    std::erase_if(roots_, [](const RayRoot& root) { return !(root.t > 0.0); });
    return roots_;
  }

 private:
  void follow(RectanglePart part, std::vector<RectanglePart>& stack) {
    for (bool alongU = true;; alongU = !alongU) {
      const dvec2 width = part.high - part.low;
      rectanglePart(patch_.degreeU, patch_.degreeV, patch_.points.data(), part, points_.data());
      // At collapsed sides a part that is large in the domain is a point.
      if ((width.x <= settings_.width && width.y <= settings_.width) || isSmall()) {
        report(0.5 * (part.low + part.high));
        return;
      }
      const int axis = (alongU ? width.x > settings_.width : width.y <= settings_.width) ? 0 : 1;
      ++counts_.steps;
      const std::optional<ClipRange> left = clipped(axis);
      if (!left) return;
      const double from = part.low[axis];
      part.low[axis] = from + left->low * width[axis], part.high[axis] = from + left->high * width[axis];
      if (left->high - left->low <= settings_.split) continue;
      ++counts_.splits;
      // Along the wider side, so that both shrink.
      const int wide = part.high.x - part.low.x >= part.high.y - part.low.y ? 0 : 1;
      RectanglePart other = part;
      const double middle = 0.5 * (part.low[wide] + part.high[wide]);
      part.high[wide] = middle, other.low[wide] = middle;
      stack.push_back(other);
    }
  }

  bool isSmall() const {
    return std::all_of(points_.begin(), points_.begin() + static_cast<std::ptrdiff_t>(patch_.points.size()),
                       [&](const dvec4& p) { return std::hypot(p.x, p.y) <= 0.5 * tolerance_ * p.w; });
  }

  /// Share of the part with the control points points_ that may contain roots along `axis`.
  std::optional<ClipRange> clipped(int axis) const {
    const int m = patch_.degreeU, n = patch_.degreeV;
    const auto at = [&](int i, int j) { return dvec2(points_[static_cast<size_t>(i + (m + 1) * j)]); };
    // The line through the ray along the other axis: distances from it depend on this axis most.
    dvec2 line = axis == 0 ? (at(0, n) - at(0, 0)) + (at(m, n) - at(m, 0))
                           : (at(m, 0) - at(0, 0)) + (at(m, n) - at(0, n));
    const double length = glm::length(line);
    line = length > 0.0 ? line / length : (axis == 0 ? dvec2(0.0, 1.0) : dvec2(1.0, 0.0));
    const int along = axis == 0 ? m : n, across = axis == 0 ? n : m;
    std::array<double, kMaxDegree + 1> bottom, top;
    bottom.fill(1e300), top.fill(-1e300);
    for (int i = 0; i <= along; ++i)
      for (int j = 0; j <= across; ++j) {
        const dvec2 p = axis == 0 ? at(i, j) : at(j, i);
        const double distance = line.x * p.y - line.y * p.x;
        auto& low = bottom[static_cast<size_t>(i)];
        auto& high = top[static_cast<size_t>(i)];
        low = std::min(low, distance), high = std::max(high, distance);
      }
    return hullCrossing(along, bottom, top, 1e-13 * largest_);
  }

  void report(dvec2 at) {
    std::array<dvec4, kMostPoints> points;
    rectanglePart(patch_.degreeU, patch_.degreeV, patch_.points.data(), {at, at}, points.data());
    const dvec4 p = points[0];
    if (!(std::hypot(p.x, p.y) <= tolerance_ * p.w)) {
      ++counts_.falseReports;
      return;
    }
    const double t = p.z / p.w;
    for (const RayRoot& other : roots_)
      // In space, not in the domain: at a collapsed side the same place has many parameters.
      // Along the ray a slanted surface stays within the tolerance for longer.
      if (std::abs(other.t - t) <= 50.0 * tolerance_) {
        ++counts_.duplicates;
        return;
      }
    roots_.push_back({t, rectanglePoint(at.x, at.y)});
  }

  const PatchOnRay& patch_;
  double tolerance_, largest_ = 0.0;
  ClipSettings settings_;
  RootCounts& counts_;
  std::array<dvec4, kMostPoints> points_;  // of the part
  std::vector<RayRoot> roots_;
};

}  // namespace

std::vector<RayRoot> clippedRoots(const PatchOnRay& rectangle, double tolerance, const ClipSettings& settings,
                                  RootCounts* counts) {
  RootCounts unused;
  return Clipping(rectangle, tolerance, settings, counts ? *counts : unused).run();
}

}  // namespace limen::surfaces
