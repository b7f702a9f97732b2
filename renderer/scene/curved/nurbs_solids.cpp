// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/curved/nurbs_solids.h"

#include <cmath>

#include "renderer/surfaces/patch_builder.h"

namespace limen::scene {
namespace {

/// The circle of nine points (Piegl and Tiller 1997, section 7.5), counter-clockwise seen from above.
const std::vector<double> kCircleKnots = {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4};
constexpr std::array<glm::dvec2, 9> kCircle = {
    {{1, 0}, {1, -1}, {0, -1}, {-1, -1}, {-1, 0}, {-1, 1}, {0, 1}, {1, 1}, {1, 0}}};

surfaces::NurbsSurface vaseSurface() {
  return nurbsRevolved({0.7, 0.0, 0.1}, 3, {0, 0, 0, 0, 0.3, 0.45, 0.7, 0.7, 0.7, 1, 1, 1, 1},
                       {{0, 0.005},
                        {0.3, 0.0},
                        {0.45, 0.25},
                        {0.05, 0.5},
                        {0.2, 0.8},
                        {0.3, 0.95},
                        {0.27, 0.98},
                        {0.12, 0.8},
                        {0, 0.3}});
}

constexpr glm::vec3 kBallAlbedo{0.7F, 0.45F, 0.4F}, kVaseAlbedo{0.5F, 0.6F, 0.7F},
    kSheetAlbedo{0.6F, 0.66F, 0.5F};
constexpr glm::dvec3 kBallCentre{-0.75, 0.4, 0.2}, kSheetMiddle{0.0, 0.45, -0.7};

/// All of the square but circles in rows. The first loop lies outside the square, so that no curve runs along
/// its sides.
surfaces::TrimRegion windows(int columns, int rows, double radius, glm::dvec2 low, glm::dvec2 high) {
  surfaces::TrimRegion out{{{{-1, -1}, {2, -1}, {2, 2}, {-1, 2}}}};
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i)
      out.loops.push_back(surfaces::trimCircle(
          low + (high - low) * glm::dvec2((i + 0.5) / columns, (j + 0.5) / rows), radius, 16));
  return out;
}

/// Two rings inside each other and the disc in their middle.
surfaces::TrimRegion rings() {
  surfaces::TrimRegion out;
  for (const double radius : {0.46, 0.36, 0.27, 0.18, 0.1})
    out.loops.push_back(surfaces::trimCircle(glm::dvec2(0.5), radius, 48));
  return out;
}

}  // namespace

surfaces::NurbsSurface nurbsRevolved(glm::dvec3 foot, int degree, const std::vector<double>& knots,
                                     const std::vector<glm::dvec2>& profile) {
  surfaces::NurbsSurface out;
  out.degreeU = 2, out.degreeV = degree;
  out.knotsU = kCircleKnots, out.knotsV = knots;
  for (const glm::dvec2 p : profile)
    for (size_t i = 0; i < kCircle.size(); ++i)
      out.points.push_back(surfaces::weighted(foot + glm::dvec3(p.x * kCircle[i].x, p.y, p.x * kCircle[i].y),
                                              i % 2 ? std::sqrt(0.5) : 1.0));
  return out;
}

surfaces::NurbsSurface nurbsSphere(glm::dvec3 centre, double radius) {
  surfaces::NurbsSurface out =
      nurbsRevolved(centre, 2, {0, 0, 0, 1, 1, 2, 2, 2},
                    {{0, -radius}, {radius, -radius}, {radius, 0}, {radius, radius}, {0, radius}});
  for (size_t j = 1; j < 5; j += 2)
    for (size_t i = 0; i < kCircle.size(); ++i) out.points[i + kCircle.size() * j] *= std::sqrt(0.5);
  return out;
}

surfaces::NurbsSurface nurbsSheet(glm::dvec3 middle, double half) {
  surfaces::NurbsSurface out;
  out.degreeU = 3, out.degreeV = 5;
  out.knotsU = {0, 0, 0, 0, 0.2, 0.5, 0.5, 0.9, 1, 1, 1, 1};
  out.knotsV = {0, 0, 0, 0, 0, 0, 0.35, 0.6, 1, 1, 1, 1, 1, 1};
  const int m = out.pointsU(), n = out.pointsV();
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < m; ++i) {
      const double x = 2.0 * i / (m - 1.0) - 1.0, z = 1.0 - 2.0 * j / (n - 1.0);
      const glm::dvec3 p =
          middle + half * glm::dvec3(x, 0.25 * std::sin(4.0 * x + 1.0) * std::cos(3.0 * z), z);
      out.points.push_back(surfaces::weighted(p, 1.0 + 0.5 * std::sin(7.0 * i + 3.0 * j)));
    }
  return out;
}

std::vector<NurbsSolid> nurbsSolids() {
  std::vector<NurbsSolid> out;
  const auto add = [&](const char* name, const surfaces::NurbsSurface& surface, glm::vec3 albedo) {
    out.push_back({name, nurbsPatches(surface), albedo, surface});
  };
  add("ball", nurbsSphere(kBallCentre, 0.38), kBallAlbedo);
  add("vase", vaseSurface(), kVaseAlbedo);
  add("sheet", nurbsSheet(kSheetMiddle, 0.6), kSheetAlbedo);
  return out;
}

std::vector<NurbsSolid> trimmedSolids() {
  // Curves cross the boundaries of patches.
  return {
      {"ball",
       trimmedNurbsPatches(nurbsSphere(kBallCentre, 0.38), windows(7, 2, 0.055, {0.03, 0.28}, {1.0, 0.8})),
       kBallAlbedo},
      {"vase", trimmedNurbsPatches(vaseSurface(), windows(9, 3, 0.032, {0.0, 0.12}, {1.0, 0.52})),
       kVaseAlbedo},
      {"sheet", trimmedNurbsPatches(nurbsSheet(kSheetMiddle, 0.6), rings()), kSheetAlbedo}};
}

}  // namespace limen::scene
