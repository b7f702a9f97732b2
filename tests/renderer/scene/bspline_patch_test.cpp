// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/lod/bspline_patch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "renderer/scene/shapes.h"
#include "tests/renderer/scene/scene_fixtures.h"

namespace limen::scene {
namespace {

BicubicPatch randomPatch(int64_t seed) {
  Random random(seed);
  BicubicPatch patch;
  for (size_t i = 0; i < 16; ++i)
    patch.points[i] = {double(i % 4) + random.uniform(-0.3, 0.3), random.uniform(-1.0, 1.0),
                       -double(i / 4) + random.uniform(-0.3, 0.3)};
  return patch;
}

/// One coordinate of a uniform cubic B-spline curve by de Boor's recursion on the knots -3 ... 4.
double deBoor(const std::array<double, 4>& points, double t) {
  std::array<double, 4> d = points;
  for (int r = 1; r <= 3; ++r)
    for (int i = 3; i >= r; --i) {
      const double low = i - 3, high = i + 1 - r;  // knots of point i: i - 3 ... i + 1
      const double share = (t - low) / (high - low);
      d[static_cast<size_t>(i)] =
          (1 - share) * d[static_cast<size_t>(i - 1)] + share * d[static_cast<size_t>(i)];
    }
  return d[3];
}

TEST(BicubicPatch, IsTheTensorProductOfDeBoorsCurves) {
  const BicubicPatch patch = randomPatch(5);
  for (const double u : {0.0, 0.17, 0.5, 0.93, 1.0})
    for (const double v : {0.0, 0.31, 0.77, 1.0})
      for (int axis = 0; axis < 3; ++axis) {
        std::array<double, 4> rows{};
        for (size_t j = 0; j < 4; ++j)
          rows[j] = deBoor({patch.points[4 * j][axis], patch.points[4 * j + 1][axis],
                            patch.points[4 * j + 2][axis], patch.points[4 * j + 3][axis]},
                           u);
        EXPECT_NEAR(patchPoint(patch, u, v)[axis], deBoor(rows, v), 1e-13);
      }
}

TEST(BicubicPatch, NormalsAreThoseOfFiniteDifferences) {
  const BicubicPatch patch = randomPatch(7);
  const double h = 1e-5;
  for (double u = 0.05; u < 1.0; u += 0.1)
    for (double v = 0.05; v < 1.0; v += 0.1) {
      const glm::dvec3 du = (patchPoint(patch, u + h, v) - patchPoint(patch, u - h, v)) / (2 * h),
                       dv = (patchPoint(patch, u, v + h) - patchPoint(patch, u, v - h)) / (2 * h);
      // Central differences of a cubic err by h^2 / 6 of its third derivative, and by rounding / h.
      EXPECT_LT(glm::length(patchAlongU(patch, u, v) - du), 1e-9);
      EXPECT_LT(glm::length(patchAlongV(patch, u, v) - dv), 1e-9);
      EXPECT_LT(glm::length(patchNormal(patch, u, v) - glm::cross(du, dv)), 1e-8);
    }
}

TEST(BicubicPatch, TessellationConvergesWithTheSquareOfTheFactor) {
  const BicubicPatch patch = randomPatch(9);
  const auto error = [&](int factor) { return patchLevels(patch, {factor}).levels[0].statedError; };
  // A chord of a smooth surface errs by h^2 / 8 of its second derivative: halving h quarters the error.
  for (int factor = 8; factor <= 32; factor *= 2)
    EXPECT_NEAR(error(factor) / error(2 * factor), 4.0, 0.4) << factor;
}

TEST(BicubicPatch, TrianglesAndNormalsFaceTheSameWay) {
  const BicubicPatch patch = randomPatch(11);
  const Mesh mesh = tessellated(patch, 12);
  EXPECT_EQ(mesh.triangles.size(), 2U * 12 * 12);
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 n =
        glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]);
    EXPECT_GT(glm::dot(n, glm::dvec3(mesh.normals[t.x])), 0.0);
  }
}

TEST(PatchLevels, MorphIntoExactlyTheNextWhereFactorsDivide) {
  const BicubicPatch patch = randomPatch(13);
  const LodSet set = patchLevels(patch, {9, 3, 2});
  ASSERT_EQ(set.levels.size(), 3U);
  EXPECT_LT(set.levels[0].deviation, set.levels[1].deviation);
  EXPECT_LT(set.levels[1].deviation, set.levels[2].deviation);
  EXPECT_LT(set.levels[0].statedError, set.levels[1].statedError);
  EXPECT_LT(set.levels[1].statedError, set.levels[2].statedError);
  const Mesh& nine = set.levels[0].mesh;
  for (size_t i = 0; i < nine.positions.size(); ++i) {
    const int a = static_cast<int>(i) % 10, b = static_cast<int>(i) / 10;
    EXPECT_LT(glm::length(nine.morphTargets[i] - tessellatedPoint(patch, 3, a / 9.0, b / 9.0)), 1e-12);
    if (a % 3 == 0 && b % 3 == 0) {
      EXPECT_LT(glm::length(nine.morphTargets[i] - nine.positions[i]), 1e-12);
    }
  }
  // Any point of the morphed surface lies on the coarser one: both are linear over every cell of the finer.
  for (double u = 0.02; u < 1.0; u += 0.07)
    for (double v = 0.03; v < 1.0; v += 0.06) {
      const int i = static_cast<int>(u * 9), j = static_cast<int>(v * 9);
      const double x = u * 9 - i, y = v * 9 - j;
      const auto at = [&](int di, int dj) {
        return nine.morphTargets[static_cast<size_t>((j + dj) * 10 + i + di)];
      };
      const glm::dvec3 morphed = y <= x ? at(0, 0) * (1 - x) + at(1, 0) * (x - y) + at(1, 1) * y
                                        : at(0, 0) * (1 - y) + at(0, 1) * (y - x) + at(1, 1) * x;
      EXPECT_LT(glm::length(morphed - tessellatedPoint(patch, 3, u, v)), 1e-12);
    }
}

TEST(PatchScene, HasTheStudysLevelsAndATipThatPops) {
  const Scene scene = fixtures::build("lod/patch");
  const LodObject& object = scene.lodObjects[0];
  ASSERT_EQ(object.levels.size(), 3U);
  EXPECT_EQ(object.levels[0].triangleCount, 2U * 81);
  EXPECT_EQ(object.levels[1].triangleCount, 2U * 9);
  EXPECT_EQ(object.levels[2].triangleCount, 2U * 4);
  // The tip is the middle of the patch, its highest point, and factor 3 has no vertex there.
  double highest = -1e300;
  glm::dvec2 at(0.0);
  for (double u = 0.0; u <= 1.0; u += 0.0625)
    for (double v = 0.0; v <= 1.0; v += 0.0625)
      if (const double y = patchPoint(scene.patches[0], u, v).y; y > highest) highest = y, at = {u, v};
  EXPECT_EQ(at, glm::dvec2(0.5));
  EXPECT_LT(tessellatedPoint(scene.patches[0], 3, 0.5, 0.5).y, highest - 0.02);
  const Bounds bounds = scene.bounds();
  EXPECT_NEAR(bounds.high.x - bounds.low.x, 1.0, 1e-6);
}

}  // namespace
}  // namespace limen::scene
