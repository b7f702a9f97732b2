// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/lod/terrain_tiles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "renderer/scene/shapes.h"
#include "tests/renderer/scene/scene_fixtures.h"

namespace limen::scene {
namespace {

constexpr double kHalfTurn = std::numbers::pi;

HeightField field(int side = 33, int64_t seed = 3) {
  MountainSetting setting;
  setting.side = side;
  setting.size = 8.0;
  setting.relief = 2.0;
  setting.feature = 3.0;
  setting.seed = seed;
  return mountains(setting);
}

TEST(Mountains, HaveTheirReliefAndDifferBySeed) {
  const HeightField a = field(33, 3), b = field(33, 4);
  for (const double h : a.heights) EXPECT_TRUE(h >= 0.0 && h <= 2.0);
  EXPECT_GT(a.highest() - *std::min_element(a.heights.begin(), a.heights.end()), 0.5);
  EXPECT_NE(a.heights, b.heights);
  EXPECT_EQ(a.heights, field(33, 3).heights);
}

/// Height of a tile's top surface at (x, z) by its triangles.
double meshHeight(const Mesh& mesh, size_t triangles, double x, double z) {
  for (size_t t = 0; t < triangles; ++t) {
    const glm::dvec3 a = mesh.positions[mesh.triangles[t].x], b = mesh.positions[mesh.triangles[t].y],
                     c = mesh.positions[mesh.triangles[t].z];
    const double area = (b.x - a.x) * (c.z - a.z) - (c.x - a.x) * (b.z - a.z);
    const double u = ((x - a.x) * (c.z - a.z) - (c.x - a.x) * (z - a.z)) / area,
                 v = ((b.x - a.x) * (z - a.z) - (x - a.x) * (b.z - a.z)) / area;
    if (u >= -1e-12 && v >= -1e-12 && u + v <= 1.0 + 1e-12) return a.y + u * (b.y - a.y) + v * (c.y - a.y);
  }
  ADD_FAILURE() << "no triangle at " << x << ' ' << z;
  return 0.0;
}

TEST(TerrainTiles, AreRegularSubsamplesWithTheirTrueHeightDeviation) {
  const HeightField ground = field();
  const TileSetting setting{4, 8, 3, true};
  const std::vector<LodSet> tiles = terrainTiles(ground, apertures(ground, 8), setting);
  ASSERT_EQ(tiles.size(), 16U);
  for (const LodSet& tile : tiles) {
    ASSERT_EQ(tile.levels.size(), 3U);
    EXPECT_EQ(tile.levels[0].deviation, 0.0);
    for (size_t level = 0; level < 3; ++level) {
      const Mesh& mesh = tile.levels[level].mesh;
      const size_t cells = 8U >> level, top = 2 * cells * cells;
      // The first (cells + 1)^2 vertices are points of the field, in order.
      for (size_t k = 0; k < (cells + 1) * (cells + 1); ++k)
        EXPECT_NEAR(mesh.positions[k].y, ground.height(mesh.positions[k].x, mesh.positions[k].z), 1e-12);
      if (level == 0) continue;
      EXPECT_GE(tile.levels[level].statedError, tile.levels[level - 1].statedError);
      EXPECT_GE(tile.levels[level].statedError, tile.levels[level].deviation);
      double largest = 0.0;
      for (size_t k = 0; k < 81; ++k) {
        const glm::dvec3 p = tile.levels[0].mesh.positions[k];
        largest = std::max(largest, std::abs(meshHeight(mesh, top, p.x, p.z) - p.y));
      }
      EXPECT_NEAR(tile.levels[level].deviation, largest, 1e-12);
      // Vertices of a finer level morph to the height of this one.
      const Mesh& finer = tile.levels[level - 1].mesh;
      for (size_t k = 0; k < (2 * cells + 1) * (2 * cells + 1); ++k)
        EXPECT_NEAR(finer.morphTargets[k].y,
                    meshHeight(mesh, top, finer.positions[k].x, finer.positions[k].z), 1e-12);
    }
  }
}

/// Lines along a border x = const of one level: its surface's edge and its skirt's lower end, at z.
struct Border {
  std::map<double, double> top, foot;  // z -> height
  Border(const Mesh& mesh, double x) {
    for (const glm::dvec3& p : mesh.positions) {
      if (std::abs(p.x - x) > 1e-9) continue;
      const auto [t, fresh] = top.emplace(p.z, p.y);
      if (!fresh) t->second = std::max(t->second, p.y);
      const auto [f, first] = foot.emplace(p.z, p.y);
      if (!first) f->second = std::min(f->second, p.y);
    }
  }
  static double at(const std::map<double, double>& line, double z) {
    const auto after = line.lower_bound(z - 1e-12);
    if (after == line.begin() || std::abs(after->first - z) < 1e-12) return after->second;
    const auto before = std::prev(after);
    return before->second +
           (after->second - before->second) * (z - before->first) / (after->first - before->first);
  }
};

TEST(TerrainTiles, SkirtsReachBelowEveryLevelOfTheNeighbour) {
  const HeightField ground = field();
  for (const bool skirts : {true, false}) {
    const std::vector<LodSet> tiles = terrainTiles(ground, apertures(ground, 8), {4, 8, 3, skirts});
    size_t gaps = 0, places = 0;
    for (size_t tj = 0; tj < 4; ++tj)
      for (size_t ti = 0; ti + 1 < 4; ++ti) {
        const double x = ground.low + ground.spacing * 8.0 * (static_cast<double>(ti) + 1.0);
        for (const LodMesh& a : tiles[4 * tj + ti].levels)
          for (const LodMesh& b : tiles[4 * tj + ti + 1].levels) {
            const Border left(a.mesh, x), right(b.mesh, x);
            for (int k = 0; k <= 32; ++k) {
              const double z = ground.low + ground.spacing * (8.0 * static_cast<double>(tj) + k / 4.0);
              ++places;
              gaps += Border::at(left.foot, z) > Border::at(right.top, z) + 1e-12 ||
                      Border::at(right.foot, z) > Border::at(left.top, z) + 1e-12;
            }
          }
      }
    EXPECT_EQ(places, 4U * 3 * 9 * 33);
    if (skirts) {
      EXPECT_EQ(gaps, 0U);
    } else {
      EXPECT_GT(gaps, 500U) << "the test does not see a missing skirt";
    }
  }
}

TEST(CapIntersection, IsTheSolidAngleThatDirectionsFallIn) {
  Random random(11);
  constexpr int kSamples = 400000;
  struct Case {
    double a, b, d;
  };
  for (const Case& c : {Case{1.2, 0.3, 1.2}, Case{1.0, 0.8, 0.9}, Case{0.5, 0.5, 0.3}, Case{1.5, 0.4, 1.3},
                        Case{1.5, 1.4, 0.2}, Case{2.0, 1.5, 1.0}, Case{3.0, 2.5, 1.5}, Case{0.4, 0.3, 0.8},
                        Case{1.0, 0.2, 0.5}}) {
    const glm::dvec3 other(std::sin(c.d), std::cos(c.d), 0.0);
    int inside = 0;
    for (int i = 0; i < kSamples; ++i) {
      const glm::dvec3 w = random.direction();
      inside += w.y > std::cos(c.a) && glm::dot(w, other) > std::cos(c.b);
    }
    const double share = inside / double(kSamples);
    // Five standard deviations of a binomial share.
    const double tolerance =
        4.0 * kHalfTurn * 5.0 * std::sqrt(std::max(share * (1.0 - share), 1e-6) / kSamples);
    EXPECT_NEAR(capIntersection(c.a, c.b, c.d), 4.0 * kHalfTurn * share, tolerance)
        << c.a << ' ' << c.b << ' ' << c.d;
  }
}

TEST(CapIntersection, IsExactWhereCapsContainTouchOrHalveEachOther) {
  const auto cap = [](double r) { return 2.0 * kHalfTurn * (1.0 - std::cos(r)); };
  EXPECT_NEAR(capIntersection(1.0, 0.2, 0.5), cap(0.2), 1e-14);
  EXPECT_EQ(capIntersection(0.5, 0.2, 0.71), 0.0);
  // The rim of a hemisphere is a great circle: through the other's axis it halves it.
  for (const double r : {0.004653, 0.1, 1.0})
    EXPECT_NEAR(capIntersection(kHalfTurn / 2, r, kHalfTurn / 2), 0.5 * cap(r), 1e-12 * cap(r) + 1e-16);
  // Symmetric, continuous at both ends of the overlap.
  EXPECT_NEAR(capIntersection(0.7, 0.4, 0.6), capIntersection(0.4, 0.7, 0.6), 1e-14);
  EXPECT_NEAR(capIntersection(0.7, 0.4, 0.3 + 1e-9), cap(0.4), 1e-7);
  EXPECT_NEAR(capIntersection(0.7, 0.4, 1.1 - 1e-9), 0.0, 1e-7);
  // Two hemispheres share a lune: 2 (pi - d).
  EXPECT_NEAR(capIntersection(kHalfTurn / 2, kHalfTurn / 2, 1.0), 2.0 * (kHalfTurn - 1.0), 1e-12);
}

/// First hit of a ray with the bilinear surface, by small steps.
bool blocked(const HeightField& ground, glm::dvec3 from, glm::dvec3 direction) {
  const double high = ground.low + ground.spacing * (ground.side - 1), step = 0.1 * ground.spacing;
  const double flat = std::hypot(direction.x, direction.z);
  if (flat < 1e-6) return false;
  for (double t = step;; t += step) {
    const glm::dvec3 p = from + direction * (t / flat);
    if (p.x < ground.low || p.z < ground.low || p.x > high || p.z > high || p.y > 3.0) return false;
    if (ground.height(p.x, p.z) > p.y + 1e-9) return true;
  }
}

TEST(Aperture, IsTheSolidAngleAndMeanOfTheSkyThatRaysReach) {
  const HeightField ground = field(33, 5);
  Random random(1);
  for (const glm::ivec2 at : {glm::ivec2(16, 16), glm::ivec2(7, 20), glm::ivec2(0, 0), glm::ivec2(25, 9)}) {
    const Aperture aperture = apertureOf(horizon(ground, ground.highest(), at.x, at.y, 256));
    const glm::dvec3 point = ground.point(at.x, at.y);
    constexpr int kSide = 160;
    double solidAngle = 0.0;
    glm::dvec3 mean(0.0);
    // Equal areas on the upper hemisphere, jittered.
    for (int j = 0; j < kSide; ++j)
      for (int i = 0; i < kSide; ++i) {
        const double y = (j + random.uniform(0.0, 1.0)) / kSide,
                     azimuth = 2.0 * kHalfTurn * (i + random.uniform(0.0, 1.0)) / kSide;
        const double r = std::sqrt(1.0 - y * y);
        const glm::dvec3 w(r * std::cos(azimuth), y, r * std::sin(azimuth));
        if (blocked(ground, point, w)) continue;
        solidAngle += 2.0 * kHalfTurn / (kSide * kSide);
        mean += w;
      }
    // The horizon meets the surface once a cell; between, a bilinear ridge may stand higher by a small part
    // of a cell's relief: a few hundredths of a radian at most at neighbouring cells.
    EXPECT_NEAR(2.0 * kHalfTurn * (1.0 - std::cos(aperture.angleRad)), solidAngle, 0.04 * 2.0 * kHalfTurn);
    EXPECT_GT(glm::dot(aperture.axis, glm::normalize(mean)), std::cos(0.05));
  }
}

TEST(Aperture, OfAWallIsHalfTheSkyLeaningAway) {
  // A cliff of practically infinite height along one side: the horizon is pi/2 over half of the azimuths.
  std::vector<double> horizonRad(360, 0.0);
  for (size_t k = 0; k < 180; ++k) horizonRad[k] = kHalfTurn / 2;  // towards +z
  const Aperture aperture = apertureOf(horizonRad);
  EXPECT_NEAR(2.0 * kHalfTurn * (1.0 - std::cos(aperture.angleRad)), kHalfTurn, 1e-12);
  // Quarter sphere z < 0, y > 0: its mean direction is (0, 1, -1).
  EXPECT_NEAR(glm::length(aperture.axis - glm::normalize(glm::dvec3(0, 1, -1))), 0.0, 1e-4);
  // The open plain: the whole sky, straight up; a flat surface gets all of sun and sky.
  const Aperture open = apertureOf(std::vector<double>(24, 0.0));
  EXPECT_NEAR(open.angleRad, kHalfTurn / 2, 1e-12);
  const ApertureLight light = apertureLight(open, {0, 1, 0}, glm::normalize(glm::dvec3(0, 1, 1)), 0.0047);
  EXPECT_NEAR(light.sky, 1.0, 1e-12);
  EXPECT_NEAR(light.sun, std::sqrt(0.5), 1e-9);
}

TEST(TerrainScene, BuildsItsTilesWithoutALevelSmallerThanTwoCells) {
  const Scene scene = fixtures::build(
      "lod/terrain",
      {{"tiles.per_side", int64_t{2}}, {"tiles.cells", int64_t{8}}, {"tiles.levels", int64_t{6}}});
  ASSERT_EQ(scene.lodObjects.size(), 4U);
  for (const LodObject& object : scene.lodObjects) {
    ASSERT_EQ(object.levels.size(), 3U);
    EXPECT_GT(object.levels[2].triangleCount, 8U - 1);
    EXPECT_GT(object.levels[2].deviation, 0.0);
  }
}

}  // namespace
}  // namespace limen::scene
