// SPDX-License-Identifier: BSD-3-Clause
// Maps of positions and directions against searches over all points, in double precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "renderer/visibility_fields/map_functions.h"
#include "renderer/visibility_fields/position_map.h"
#include "tests/renderer/visibility_fields/nearest_search.h"

namespace limen::visibility_fields {
namespace {

TEST(PositionMap, LatticeHasTheNumbersOfFiveLevels) {
  for (const size_t count : {82, 290, 1090, 4226, 16642})
    EXPECT_EQ(PositionMap(PositionForm::Lattice, int(count)).points().size(), count);
  // The nearest that 2 n^2 and 6 n^2 allow to 1090.
  EXPECT_EQ(PositionMap(PositionForm::Grid, 1090).points().size(), 2U * 23 * 23);
  EXPECT_EQ(PositionMap(PositionForm::Box, 1090).points().size(), 6U * 13 * 13);
}

// The inverse compares cosines in single precision: two points whose cosines differ by less than their
// rounding, 3 2^-24, count as equally near. A distance r between unit vectors has r^2 = 2 - 2 cos, so that
// its square is off by 6 2^-24 at most, and twice that for the rounding of the coordinates themselves.
TEST(PositionMap, InverseIsTheNearestOfAllPoints) {
  constexpr double kTie = 12.0 * 0x1p-24;
  for (const PositionForm form : {PositionForm::Lattice, PositionForm::Grid, PositionForm::Box})
    for (const int count : {82, 290, 1090, 4226, 16642}) {
      const PositionMap map(form, count);
      const Search search(map.points());
      std::mt19937_64 engine(7);
      const int tests = form == PositionForm::Lattice ? 1000000 : 100000;
      int wrong = 0;
      for (int i = 0; i < tests; ++i) {
        const glm::dvec3 p = randomPoint(engine, i);
        const double best = search.nearestDistance(p);
        const double found = glm::distance(glm::dvec3(map.points()[size_t(map.nearest(glm::vec3(p)))]), p);
        wrong += found * found > best * best + kTie;
      }
      EXPECT_EQ(wrong, 0) << toText(form) << ' ' << count;
    }
}

TEST(PositionMap, EveryPositionIsItsOwnNearest) {
  for (const PositionForm form : {PositionForm::Lattice, PositionForm::Grid, PositionForm::Box}) {
    const PositionMap map(form, 4226);
    for (const glm::vec3 p : map.points())
      EXPECT_LT(glm::distance(map.points()[size_t(map.nearest(p))], p), 1e-6F) << toText(form);
  }
}

/// Greatest over mean of the areas nearest to each position, from `tests` random points.
double unevenness(const PositionMap& map, int tests) {
  std::mt19937_64 engine(3);
  std::normal_distribution<> normal;
  std::vector<int> hits(map.points().size());
  for (int i = 0; i < tests; ++i)
    ++hits[size_t(
        map.nearest(glm::vec3(glm::normalize(glm::dvec3(normal(engine), normal(engine), normal(engine))))))];
  return *std::max_element(hits.begin(), hits.end()) * double(map.points().size()) / tests;
}

// Closed forms of the areas for many positions. Grid: on the equator pi / 2 of the mean (rows and columns pi
// / n apart, 4 pi / (2 n^2) on average). Box: in the middle of a face 4 / m^2 against 4 pi / (6 m^2), 6 / pi.
TEST(PositionMap, LatticeIsMoreEvenThanGridAndBox) {
  constexpr int kTests = 2000000;  // 1835 for each position: 5 standard deviations are 12 %
  const double lattice = unevenness(PositionMap(PositionForm::Lattice, 1090), kTests);
  const double grid = unevenness(PositionMap(PositionForm::Grid, 1090), kTests);
  const double box = unevenness(PositionMap(PositionForm::Box, 1090), kTests);
  RecordProperty("lattice", std::to_string(lattice));
  EXPECT_NEAR(grid, 0.5 * M_PI, 0.12 * 0.5 * M_PI);
  EXPECT_NEAR(box, 6.0 / M_PI, 0.12 * 6.0 / M_PI);
  EXPECT_LT(lattice, grid);
  EXPECT_LT(lattice, box);
}

constexpr int kForms[] = {kFieldPolar, kFieldRejection, kFieldConcentric};

TEST(DirectionMap, RoundTripsWithin1e5) {
  std::mt19937_64 engine(11);
  for (const int form : kForms) {
    double worst = 0.0, worstPlace = 0.0;
    for (int i = 0; i < 1000000; ++i) {
      glm::vec3 d(randomPoint(engine, i));
      d.z = std::abs(d.z);
      const glm::vec3 back = fieldDirection(fieldPlace(d, form), form);
      // Near the horizon z is the root of what rounding leaves, and x and y are what the map holds.
      worst = std::max({worst, double(std::abs(back.x - d.x)), double(std::abs(back.y - d.y)),
                        std::abs(double(back.z) * back.z - double(d.z) * d.z)});
      std::uniform_real_distribution<float> uniform(0.001F, 0.999F);
      const glm::vec2 place(uniform(engine), uniform(engine));
      if (form == kFieldRejection && glm::length(2.0F * place - 1.0F) > 0.999F) continue;
      const glm::vec2 again = fieldPlace(fieldDirection(place, form), form);
      // A turn of the polar map's axis moves nothing.
      const float weight = form == kFieldPolar ? std::sin(0.5F * kFieldPi * place.x) : 1.0F;
      worstPlace = std::max(
          {worstPlace, double(std::abs(again.x - place.x)), double(weight * std::abs(again.y - place.y))});
    }
    EXPECT_LT(worst, 1e-5) << form;
    EXPECT_LT(worstPlace, 1e-5) << form;
  }
}

// Shirley and Chiu 1997 as printed, in double precision: quarters by the angle of the disc's point.
glm::dvec2 concentricPlace(glm::dvec2 p) {
  const double r = glm::length(p);
  double phi = std::atan2(p.y, p.x);
  if (phi < -M_PI / 4) phi += 2 * M_PI;
  glm::dvec2 square;
  if (phi < M_PI / 4)
    square = {r, phi * r / (M_PI / 4)};
  else if (phi < 3 * M_PI / 4)
    square = {-(phi - M_PI / 2) * r / (M_PI / 4), r};
  else if (phi < 5 * M_PI / 4)
    square = {-r, -(phi - M_PI) * r / (M_PI / 4)};
  else
    square = {(phi - 3 * M_PI / 2) * r / (M_PI / 4), -r};
  return 0.5 * square + 0.5;
}

TEST(DirectionMap, ConcentricInverseIsThatOfShirleyAndChiu) {
  std::mt19937_64 engine(12);
  for (int i = 0; i < 100000; ++i) {
    const glm::dvec3 d = randomPoint(engine, i);
    const glm::vec2 place = fieldPlace(glm::vec3(d), kFieldConcentric);
    const glm::dvec2 expected = concentricPlace(d);
    ASSERT_NEAR(place.x, expected.x, 1e-6);
    ASSERT_NEAR(place.y, expected.y, 1e-6);
  }
}

/// Angle between two places of the polar map counts around its axis.
double placeDistance(glm::dvec2 a, glm::dvec2 b, int form) {
  glm::dvec2 d = a - b;
  if (form == kFieldPolar) d.y -= std::round(d.y);
  return glm::length(d);
}

// The texel found is the used one whose middle is nearest in the map's square. In the empty corners of the
// rejection map, where a neighbour stands in, it is within a texel of the nearest.
TEST(DirectionMap, TexelIsTheNearestOfAll) {
  constexpr int kSide = 8;
  std::mt19937_64 engine(13);
  for (const int form : kForms) {
    int standIns = 0;
    for (int i = 0; i < 1000000; ++i) {
      glm::vec3 d(randomPoint(engine, i));
      d.z = std::abs(d.z);
      const glm::dvec2 place(fieldPlace(d, form));
      double best = 9.0;
      for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
          if (fieldTexelUsed({x, y}, kSide, form))
            best = std::min(best, placeDistance((glm::dvec2(x, y) + 0.5) / double(kSide), place, form));
      const glm::ivec2 texel = fieldTexel(d, kSide, form);
      ASSERT_TRUE(fieldTexelUsed(texel, kSide, form));
      const double found = placeDistance((glm::dvec2(texel) + 0.5) / double(kSide), place, form);
      const bool standIn = best > std::sqrt(0.5) / kSide || found > std::sqrt(0.5) / kSide + 1e-6;
      standIns += standIn;
      ASSERT_LE(found, best + (standIn ? 1.0 / kSide : 1e-6)) << form;
    }
    if (form != kFieldRejection) {
      EXPECT_EQ(standIns, 0);
    }
  }
}

// Outside the disc in the square lies 1 - pi / 4 = 21.46 % of it. Of 256^2 texels, those cut by the circle,
// at most 8 * 128, may count either way: 1.6 %.
TEST(DirectionMap, RejectionLeavesACornerUnused) {
  constexpr int kSide = 256;
  for (const int form : kForms) {
    int unused = 0;
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) unused += !fieldTexelUsed({x, y}, kSide, form);
    const double share = double(unused) / (kSide * kSide);
    if (form == kFieldRejection)
      EXPECT_NEAR(share, 1.0 - M_PI / 4.0, 0.016 / 8.0);
    else
      EXPECT_EQ(unused, 0);
  }
}

// Texel middles of the concentric and the rejection map are spread by the cosine: of those, a share sin^2(a)
// lies within the angle a of the axis; for the polar map it is a / (pi / 2).
TEST(DirectionMap, DensityFollowsTheCosine) {
  constexpr int kSide = 128;
  for (const int form : kForms)
    for (const double degrees : {15.0, 30.0, 45.0, 60.0, 75.0}) {
      const double a = glm::radians(degrees);
      int within = 0, used = 0;
      for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
          if (!fieldTexelUsed({x, y}, kSide, form)) continue;
          ++used;
          const glm::vec2 place = (glm::vec2(x, y) + 0.5F) / float(kSide);
          within += fieldDirection(place, form).z >= std::cos(a);
        }
      const double expected = form == kFieldPolar ? degrees / 90.0 : std::sin(a) * std::sin(a);
      // Texels that the angle's circle cuts, at most 8 radii of them in texels of 2 / side.
      EXPECT_NEAR(double(within) / used, expected, 8.0 / kSide) << form << ' ' << degrees;
    }
}

TEST(Frame, IsOrthonormalAndRightHanded) {
  std::mt19937_64 engine(14);
  for (int i = 0; i < 100000; ++i) {
    const glm::vec3 z(randomPoint(engine, i));
    const glm::dvec3 x(fieldTangent(z)), y(fieldBitangent(z));
    ASSERT_NEAR(glm::dot(x, y), 0.0, 1e-6);
    ASSERT_NEAR(glm::length(x), 1.0, 1e-6);
    ASSERT_LT(glm::distance(glm::cross(x, y), glm::dvec3(z)), 2e-6);
  }
}

// Codes are half a step off at most, and the far pole is no miss.
TEST(Codes, HitsAreWithinHalfAStepAndNeverMisses) {
  for (const int bits : {8, 16})
    for (int i = 0; i <= 10000; ++i) {
      const float share = float(i) / 10000.0F;
      const uint32_t code = fieldHitCode(share, bits);
      ASSERT_LT(code, fieldMissCode(bits));
      ASSERT_NEAR(float(code) * fieldCodeStep(bits), share, 0.5F * fieldCodeStep(bits) + 1e-7F);
    }
  EXPECT_NE(fieldHitCode(0.5F, 1), fieldMissCode(1));
}

}  // namespace
}  // namespace limen::visibility_fields
