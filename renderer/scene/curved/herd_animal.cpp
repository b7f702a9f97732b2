// SPDX-License-Identifier: BSD-3-Clause
// In place of the Killeroo of Schwarz 2009 (Table 7.4), whose data are not free: the same number of patches,
// 11,532 = 12 x 31 x 31, in other shapes.
#include "renderer/scene/curved/herd_animal.h"

#include <algorithm>
#include <cmath>

#include "renderer/surfaces/neighbours.h"
#include "renderer/surfaces/patch_builder.h"

namespace limen::scene {
namespace {

/// Centre and half axes of a tube's cross-section; the section lies across the line of centres, `tall` in the
/// plane of symmetry and `wide` along z.
struct Ring {
  glm::dvec2 centre;  ///< x, y
  double tall, wide;
};

/// A tube through rings at equal parameters, closed to a point at both ends.
struct Limb {
  std::vector<Ring> rings;
  double z = 0.0;         ///< of the whole limb
  double wrinkles = 0.0;  ///< share of the radius
  int around, along;      ///< patches
};

template <class Value>
Value spline(const std::vector<Value>& values, double t) {
  const double at = std::clamp(t, 0.0, 1.0) * double(values.size() - 1);
  const auto i = std::min(static_cast<size_t>(at), values.size() - 2);
  const double f = at - double(i);
  const Value &b = values[i], &c = values[i + 1], &a = i > 0 ? values[i - 1] : b,
              &d = i + 2 < values.size() ? values[i + 2] : c;
  return 0.5 * (2.0 * b + f * (c - a + f * (2.0 * a - 5.0 * b + 4.0 * c - d + f * (3.0 * (b - c) + d - a))));
}

/// B-spline control point of a limb: `s` along it (0..1), `angle` around it.
glm::dvec3 controlPoint(const Limb& limb, double s, double angle) {
  std::vector<glm::dvec2> centres, radii;
  for (const Ring& ring : limb.rings)
    centres.push_back(ring.centre), radii.emplace_back(ring.tall, ring.wide);
  const glm::dvec2 centre = spline(centres, s), ahead = spline(centres, s + 1e-3),
                   behind = spline(centres, s - 1e-3);
  const glm::dvec2 along = glm::normalize(ahead - behind), up(-along.y, along.x);
  // Round ends, and no wrinkles there.
  const double end = std::min(s, 1.0 - s), cap = std::sqrt(std::min(1.0, end * (2.0 - end / 0.08) / 0.08));
  const double fold = std::sin(40.0 * s + 2.0 * std::sin(3.0 * angle)) * std::sin(5.0 * angle + 9.0 * s);
  const double scale = (end < 0.08 ? cap : 1.0) * (1.0 + limb.wrinkles * fold * std::min(1.0, end / 0.1));
  const glm::dvec2 radius = glm::max(spline(radii, s), 0.0) * scale;
  const glm::dvec2 xy = centre + up * (radius.x * std::cos(angle));
  return {xy.x, xy.y, limb.z + radius.y * std::sin(angle)};
}

/// Control points of one segment of a uniform cubic B-spline as a Bézier curve; of the last point only.
template <class Point>
glm::dvec4 middlePoint(Point at, int i, int part) {
  if (part == 0) return (at(i - 1) + 4.0 * at(i) + at(i + 1)) / 6.0;
  return part == 1 ? (2.0 * at(i) + at(i + 1)) / 3.0 : (at(i) + 2.0 * at(i + 1)) / 3.0;
}

void addLimb(surfaces::PatchSet& set, const Limb& limb) {
  const int m = limb.around, n = limb.along;
  // Rows -1 to n + 1: row 0 and row n are the tips, and the rows beyond lie across from those inside, so that
  // the surface passes smoothly through its end.
  const auto control = [&](int i, int j) {
    const double angle = 2.0 * M_PI * ((i % m + m) % m) / m;
    if (j < 0) return glm::dvec4(controlPoint(limb, 1.0 / n, angle + M_PI), 1.0);
    if (j > n) return glm::dvec4(controlPoint(limb, (n - 1.0) / n, angle + M_PI), 1.0);
    return glm::dvec4(controlPoint(limb, double(j) / n, j == 0 || j == n ? 0.0 : angle), 1.0);
  };
  std::vector<std::vector<glm::dvec4>> spline(static_cast<size_t>(n) + 3);
  for (int j = -1; j <= n + 1; ++j)
    for (int i = 0; i < m; ++i) spline[static_cast<size_t>(j + 1)].push_back(control(i, j));
  // The Bézier net of the whole tube: rows of 3 m points, 3 n + 1 rows.
  const auto splinePoint = [&](int i, int j) {
    return spline[static_cast<size_t>(j + 1)][static_cast<size_t>((i % m + m) % m)];
  };
  std::vector<std::vector<glm::dvec4>> net;
  for (int row = 0; row <= 3 * n; ++row) {
    std::vector<glm::dvec4> points;
    for (int column = 0; column < 3 * m; ++column)
      points.push_back(middlePoint(
          [&](int i) { return middlePoint([&](int j) { return splinePoint(i, j); }, row / 3, row % 3); },
          column / 3, column % 3));
    // The tip is a point but for rounding.
    if (row == 0 || row == 3 * n) points.assign(points.size(), points[0]);
    net.push_back(std::move(points));
  }
  for (int t = 0; t < n; ++t)
    for (int s = 0; s < m; ++s) {
      std::array<glm::dvec4, 16> patch;
      for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i)
          patch[static_cast<size_t>(i + 4 * j)] =
              net[static_cast<size_t>(3 * t + j)][static_cast<size_t>((3 * s + i) % (3 * m))];
      addRectangle(set, 3, 3, patch);
    }
}

Limb leg(double x, double z) {
  return {{{{x, 0.72}, 0.13, 0.1},
           {{x, 0.5}, 0.11, 0.09},
           {{x - 0.03, 0.28}, 0.06, 0.06},
           {{x, 0.1}, 0.05, 0.05},
           {{x + 0.02, 0.04}, 0.07, 0.06},
           {{x + 0.03, 0.0}, 0.07, 0.06}},
          z,
          0.02,
          20,
          31};
}

Limb ear(double z) {
  return {
      {{{0.86, 1.2}, 0.03, 0.02}, {{0.83, 1.28}, 0.045, 0.02}, {{0.8, 1.36}, 0.03, 0.015}}, z, 0.0, 31, 10};
}

}  // namespace

surfaces::PatchSet herdAnimal() {
  surfaces::PatchSet set;
  const std::vector<Limb> limbs = {
      {{{{-0.6, 0.78}, 0.16, 0.14},
        {{-0.4, 0.8}, 0.24, 0.2},
        {{-0.1, 0.76}, 0.25, 0.23},
        {{0.2, 0.78}, 0.24, 0.21},
        {{0.45, 0.84}, 0.2, 0.17},
        {{0.55, 0.87}, 0.14, 0.12}},
       0.0,
       0.03,
       96,
       62},
      {{{{0.35, 0.82}, 0.17, 0.13},
        {{0.55, 0.98}, 0.14, 0.1},
        {{0.7, 1.13}, 0.1, 0.08},
        {{0.8, 1.2}, 0.09, 0.07}},
       0.0,
       0.03,
       31,
       40},
      {{{{0.72, 1.18}, 0.1, 0.09},
        {{0.84, 1.18}, 0.11, 0.1},
        {{0.98, 1.1}, 0.07, 0.07},
        {{1.06, 1.05}, 0.06, 0.06}},
       0.0,
       0.02,
       31,
       30},
      ear(0.07),
      ear(-0.07),
      leg(-0.42, 0.13),
      leg(-0.42, -0.13),
      leg(0.36, 0.12),
      leg(0.36, -0.12),
      {{{{-0.58, 0.88}, 0.04, 0.04}, {{-0.72, 0.78}, 0.03, 0.03}, {{-0.76, 0.6}, 0.02, 0.02}},
       0.0,
       0.0,
       31,
       10}};
  for (const Limb& limb : limbs) addLimb(set, limb);
  surfaces::findNeighbours(set);
  return set;
}

}  // namespace limen::scene
