// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "renderer/surfaces/blossom.h"
#include "renderer/surfaces/ray_roots.h"

namespace limen::surfaces {
namespace {

using glm::dvec2;
using glm::dvec3;
using glm::dvec4;

/// A part of the domain: corners of a triangle in barycentric coordinates, or a rectangle.
struct HullPart {
  TrianglePart triangle = kWholeTriangle;
  RectanglePart rectangle;
  int depth = 0;
};

constexpr int kMostDepth = 45;
/// More parts than a ray that crosses a patch needs: it lies within the surface.
constexpr int64_t kMostParts = 200000;

class HullSearch {
 public:
  HullSearch(const PatchOnRay& patch, double tolerance, RootCounts& counts)
      : patch_(patch), tolerance_(tolerance), counts_(counts), count_(patch.points.size()) {
    double largest = 0.0;
    for (const dvec4& p : patch.points) largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
    rounding_ = 1e-14 * largest;
  }

  std::vector<RayRoot> run() {
    std::vector<HullPart> stack = {HullPart{}};
    std::vector<RayRoot> roots;
    int64_t looked = 0;
    while (!stack.empty()) {
      const HullPart part = stack.back();
      stack.pop_back();
      ++counts_.steps;
      std::array<dvec4, kMostPoints> points;
      if (patch_.domain == Domain::Triangle) {
        trianglePart(patch_.degreeU, patch_.points.data(), part.triangle, points.data());
      } else {
        rectanglePart(patch_.degreeU, patch_.degreeV, patch_.points.data(), part.rectangle, points.data());
      }
      if (misses({points.data(), count_})) continue;
      if (part.depth >= kMostDepth || ++looked > kMostParts || isSmall({points.data(), count_})) {
        report(part, roots);
        continue;
      }
      split(part, stack);
    }
    std::sort(roots.begin(), roots.end(), [](const RayRoot& a, const RayRoot& b) { return a.t < b.t; });
    std::erase_if(roots, [](const RayRoot& root) { return !(root.t > 0.0); });
    return roots;
  }

 private:
  /// The hull lies to one side of the ray, seen along it: of eight sides.
  bool misses(std::span<const dvec4> points) const {
    double low[4] = {1e300, 1e300, 1e300, 1e300}, high[4] = {-1e300, -1e300, -1e300, -1e300};
    for (const dvec4& p : points) {
      const double values[4] = {p.x, p.y, p.x + p.y, p.x - p.y};
      for (int i = 0; i < 4; ++i)
        low[i] = std::min(low[i], values[i]), high[i] = std::max(high[i], values[i]);
    }
    for (int i = 0; i < 4; ++i)
      if (low[i] > rounding_ || high[i] < -rounding_) return true;
    return false;
  }

  bool isSmall(std::span<const dvec4> points) const {
    return std::all_of(points.begin(), points.end(), [&](const dvec4& p) {
      return p.x * p.x + p.y * p.y <= tolerance_ * tolerance_ * p.w * p.w;
    });
  }

  void split(const HullPart& part, std::vector<HullPart>& stack) const {
    if (patch_.domain == Domain::Triangle) {
      for (const TrianglePart& quarter : quartersOf(part.triangle))
        stack.push_back({quarter, {}, part.depth + 1});
      return;
    }
    const dvec2 low = part.rectangle.low, high = part.rectangle.high, middle = 0.5 * (low + high);
    for (const RectanglePart& quarter : {RectanglePart{low, middle},
                                         {{middle.x, low.y}, {high.x, middle.y}},
                                         {{low.x, middle.y}, {middle.x, high.y}},
                                         {middle, high}})
      stack.push_back({kWholeTriangle, quarter, part.depth + 1});
  }

  void report(const HullPart& part, std::vector<RayRoot>& roots) const {
    dvec2 at = 0.5 * (part.rectangle.low + part.rectangle.high);
    if (patch_.domain == Domain::Triangle)
      at = dvec2(part.triangle[0] + part.triangle[1] + part.triangle[2]) / 3.0;
    const RayRoot found = polished(at);
    const bool known = std::any_of(roots.begin(), roots.end(), [&](const RayRoot& other) {
      return std::abs(other.at.u - found.at.u) < 1e-7 && std::abs(other.at.v - found.at.v) < 1e-7;
    });
    if (!known) roots.push_back(found);
  }

  HomogeneousJet jetAt(dvec2 at) const {
    if (patch_.domain == Domain::Triangle)
      return triangleJet(patch_.degreeU, patch_.points.data(), trianglePoint(at.x, at.y), Order::First);
    PatchSet one;
    one.points = patch_.points;
    Patch patch;
    patch.degreeU = static_cast<uint8_t>(patch_.degreeU),
    patch.degreeV = static_cast<uint8_t>(patch_.degreeV);
    return homogeneousJet(one, patch, rectanglePoint(at.x, at.y), Order::First);
  }

  /// By Newton's method, if it stays nearby and in the domain.
  RayRoot polished(dvec2 at) const {
    const dvec2 start = at;
    for (int step = 0; step < 8; ++step) {
      const HomogeneousJet jet = jetAt(at);
      const double det = jet.u.x * jet.v.y - jet.v.x * jet.u.y;
      const dvec2 move =
          dvec2(jet.p.x * jet.v.y - jet.v.x * jet.p.y, jet.u.x * jet.p.y - jet.p.x * jet.u.y) / det;
      if (!(glm::length(move) < 1e-3)) break;
      at -= move;
    }
    const bool inside = at.x >= 0.0 && at.y >= 0.0 &&
                        (patch_.domain == Domain::Triangle ? at.x + at.y <= 1.0 : at.x <= 1.0 && at.y <= 1.0);
    if (!inside || glm::length(at - start) > 1e-3) at = start;
    dvec4 p = jetAt(at).p;
    if (std::hypot(p.x, p.y) > tolerance_ * p.w) at = start, p = jetAt(at).p;
    return {p.z / p.w, domainPoint(patch_.domain, at.x, at.y)};
  }

  const PatchOnRay& patch_;
  double tolerance_, rounding_ = 0.0;
  RootCounts& counts_;
  size_t count_;
};

}  // namespace

std::vector<RayRoot> hullRoots(const PatchOnRay& patch, double tolerance, RootCounts* counts) {
  RootCounts unused;
  return HullSearch(patch, tolerance, counts ? *counts : unused).run();
}

}  // namespace limen::surfaces
