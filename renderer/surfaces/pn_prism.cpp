// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/pn_prism.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace limen::surfaces {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr double kSlack = 1e-3;

double cross2(dvec2 a, dvec2 b) { return a.x * b.y - a.y * b.x; }

double areaOf(const std::array<dvec2, 3>& t) { return 0.5 * std::abs(cross2(t[1] - t[0], t[2] - t[0])); }

/// The triangle with its sides moved outwards until all points are inside; none for a needle.
std::optional<std::array<dvec2, 3>> offsetTriangle(const std::array<dvec2, 3>& base,
                                                   std::span<const dvec2> points, double slack) {
  std::array<dvec2, 3> normals;  // outward, unit
  std::array<double, 3> reach;
  for (size_t s = 0; s < 3; ++s) {
    const dvec2 side = base[(s + 1) % 3] - base[s];
    const double length = glm::length(side);
    if (!(length > 0.0)) return std::nullopt;
    normals[s] = dvec2(side.y, -side.x) / length;
    reach[s] = -1e300;
    for (const dvec2 p : points) reach[s] = std::max(reach[s], glm::dot(normals[s], p));
    reach[s] += slack;
  }
  std::array<dvec2, 3> out;
  for (size_t s = 0; s < 3; ++s) {  // corner s is where sides s - 1 and s meet
    const size_t before = (s + 2) % 3;
    const double det = cross2(normals[before], normals[s]);
    if (!(det > 1e-6)) return std::nullopt;
    out[s] = dvec2(reach[before] * normals[s].y - reach[s] * normals[before].y,
                   reach[s] * normals[before].x - reach[before] * normals[s].x) /
             det;
  }
  return out;
}

/// Isosceles triangle around the points' box; its base is parallel to x.
std::array<dvec2, 3> boxTriangle(std::span<const dvec2> points, double slack) {
  dvec2 low(1e300), high(-1e300);
  for (const dvec2 p : points) low = glm::min(low, p), high = glm::max(high, p);
  low -= slack, high += slack;
  const double half = 0.5 * (high.x - low.x), middle = 0.5 * (low.x + high.x);
  return {dvec2{middle - 2.0 * half, low.y}, {middle + 2.0 * half, low.y}, {middle, 2.0 * high.y - low.y}};
}

/// Unit vectors of a plane through three points: x along the longest side, z its normal.
struct PlaneAxes {
  dvec3 x, y, z;
};
PlaneAxes axesOf(const std::array<dvec3, 3>& corners, double size) {
  dvec3 along = corners[1] - corners[0];
  for (size_t s = 1; s < 3; ++s) {
    const dvec3 side = corners[(s + 1) % 3] - corners[s];
    if (glm::dot(side, side) > glm::dot(along, along)) along = side;
  }
  PlaneAxes out;
  out.x = glm::length(along) > 1e-12 * size ? glm::normalize(along) : dvec3(1.0, 0.0, 0.0);
  dvec3 z = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  if (glm::length(z) > 1e-12 * size * size) {
    z = glm::normalize(z);
  } else {
    // A line: any normal will do.
    const dvec3 a = glm::abs(out.x);
    z = a.x <= a.y && a.x <= a.z ? dvec3(1, 0, 0) : a.y <= a.z ? dvec3(0, 1, 0) : dvec3(0, 0, 1);
  }
  out.y = glm::normalize(glm::cross(z, out.x));
  out.z = glm::cross(out.x, out.y);
  return out;
}

}  // namespace

PnPrism pnPrism(int n, std::span<const dvec3> points, const TrianglePart& part) {
  const size_t count = static_cast<size_t>(n + 1) * static_cast<size_t>(n + 2) / 2;
  std::vector<dvec3> all(4 * count);
  const std::array<TrianglePart, 4> quarters = quartersOf(part);
  for (size_t q = 0; q < 4; ++q) trianglePart(n, points.data(), quarters[q], &all[q * count]);
  // Corners of the part: b_n00 of quarter 0, b_0n0 of 1, b_00n of 2.
  const std::array<dvec3, 3> corners = {all[0], all[count + static_cast<size_t>(triangleIndex(n, 0, 0))],
                                        all[2 * count + static_cast<size_t>(triangleIndex(n, 0, n))]};
  dvec3 low(1e300), high(-1e300);
  for (const dvec3& p : all) low = glm::min(low, p), high = glm::max(high, p);
  const double size = glm::length(high - low), slack = kSlack * size;
  const PlaneAxes axes = axesOf(corners, size);
  const auto flat = [&](const dvec3& p) {
    return dvec2(glm::dot(axes.x, p - corners[0]), glm::dot(axes.y, p - corners[0]));
  };
  std::vector<dvec2> places;
  double bottom = 1e300, top = -1e300;
  for (const dvec3& p : all) {
    places.push_back(flat(p));
    const double height = glm::dot(axes.z, p - corners[0]);
    bottom = std::min(bottom, height), top = std::max(top, height);
  }
  bottom -= slack, top += slack;
  const std::array<dvec2, 3> base = {flat(corners[0]), flat(corners[1]), flat(corners[2])};
  std::array<dvec2, 3> outline = boxTriangle(places, slack);
  if (const auto offset = offsetTriangle(base, places, slack); offset && areaOf(*offset) <= areaOf(outline))
    outline = *offset;
  PnPrism prism;
  const double det = cross2(base[1] - base[0], base[2] - base[0]);
  for (size_t c = 0; c < 3; ++c) {
    const dvec3 at = corners[0] + axes.x * outline[c].x + axes.y * outline[c].y;
    prism.corners[c] = at + axes.z * bottom;
    prism.corners[c + 3] = at + axes.z * top;
    dvec3 weights(1.0 / 3.0);
    if (det > 1e-12 * size * size) {
      weights.y = cross2(outline[c] - base[0], base[2] - base[0]) / det;
      weights.z = cross2(base[1] - base[0], outline[c] - base[0]) / det;
      weights.x = 1.0 - weights.y - weights.z;
    }
    prism.parameters[c] = dvec2(weights.x * part[0] + weights.y * part[1] + weights.z * part[2]);
  }
  return prism;
}

std::vector<TrianglePart> partsOf(int level) {
  std::vector<TrianglePart> parts = {kWholeTriangle};
  for (; level > 0; --level) {
    std::vector<TrianglePart> next;
    for (const TrianglePart& part : parts)
      for (const TrianglePart& quarter : quartersOf(part)) next.push_back(quarter);
    parts = std::move(next);
  }
  return parts;
}

}  // namespace limen::surfaces
