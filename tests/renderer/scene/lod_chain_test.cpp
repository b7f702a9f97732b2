// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

#include "renderer/scene/closest_point.h"
#include "renderer/scene/import.h"
#include "renderer/scene/lod/mesh_chain.h"
#include "renderer/scene/lod_control.h"
#include "renderer/scene/shapes.h"
#include "tests/renderer/scene/geometry_checks.h"
#include "tests/renderer/scene/scene_fixtures.h"

namespace limen::scene {
namespace {

using fixtures::build;

double lowest(glm::dvec3 v) { return std::min({v.x, v.y, v.z}); }

TEST(ClosestPoint, IsTheNearestOfAllTriangles) {
  Random random(3);
  Mesh mesh;
  for (int i = 0; i < 300; ++i)
    mesh.positions.push_back({random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)});
  for (uint32_t i = 0; i < 100; ++i) mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  mesh.triangles.emplace_back(0, 0, 5);  // a segment
  mesh.triangles.emplace_back(7, 7, 7);  // a point
  const ClosestPoint closest(mesh);
  for (int k = 0; k < 200; ++k) {
    const glm::dvec3 p{random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2)};
    // A plain search over a fine barycentric grid of each triangle never gets nearer, and gets about as near.
    double best = 1e300;
    constexpr int kGrid = 40;
    for (const glm::uvec3& t : mesh.triangles)
      for (int i = 0; i <= kGrid; ++i)
        for (int j = 0; i + j <= kGrid; ++j) {
          const double u = i / double(kGrid), v = j / double(kGrid);
          const glm::dvec3 q =
              (1 - u - v) * mesh.positions[t.x] + u * mesh.positions[t.y] + v * mesh.positions[t.z];
          best = std::min(best, glm::length(q - p));
        }
    EXPECT_LE(closest.distance(p), best + 1e-12);
    // Cells have edges of at most 2 sqrt(3) / 40; a point lies within that of a grid point.
    EXPECT_GE(closest.distance(p), best - 2.0 * std::sqrt(3.0) / kGrid);
  }
}

TEST(SampledDeviation, OfTwoSpheresIsTheDifferenceOfTheirRadii) {
  const Mesh small = sphere(glm::dvec3(0.0), 1.0, 40), large = sphere(glm::dvec3(0.0), 1.1, 40);
  // Same directions at every vertex: exactly 0.1 there, less in the triangles by their sagitta.
  EXPECT_NEAR(sampledDeviation(small, large, 2000), 0.1, 0.1 * 2e-3);
  EXPECT_LT(sampledDeviation(small, small, 2000), 1e-15);
}

TEST(VertexNormals, OfASpherePointOutwards) {
  const Mesh mesh = sphere(glm::dvec3(0.0), 2.0, 16);
  const std::vector<glm::vec3> normals = vertexNormals(mesh);
  for (size_t i = 0; i < normals.size(); ++i)
    EXPECT_GT(glm::dot(glm::dvec3(normals[i]), mesh.positions[i] / 2.0), std::cos(0.05));
}

void expectChain(const LodSet& set, const Mesh& mesh, const std::vector<double>& kept, double slack) {
  ASSERT_EQ(set.levels.size(), kept.size() + 1);
  EXPECT_EQ(set.levels[0].mesh.triangles, mesh.triangles);
  EXPECT_EQ(set.levels[0].deviation, 0.0);
  EXPECT_EQ(set.levels[0].statedError, 0.0);
  for (size_t i = 1; i < set.levels.size(); ++i) {
    const LodMesh &level = set.levels[i], &finer = set.levels[i - 1];
    const auto count = static_cast<double>(level.mesh.triangles.size());
    EXPECT_LT(level.mesh.triangles.size(), finer.mesh.triangles.size());
    EXPECT_NEAR(count / static_cast<double>(mesh.triangles.size()), kept[i - 1], slack) << i;
    EXPECT_GT(level.deviation, finer.deviation) << i;
    EXPECT_GT(level.statedError, finer.statedError) << i;
    EXPECT_EQ(level.mesh.normals.size(), level.mesh.positions.size());
    // Every vertex of a level is one of the level before: a progressive mesh.
    std::set<std::array<double, 3>> before;
    for (const glm::dvec3& p : finer.mesh.positions) before.insert({p.x, p.y, p.z});
    for (const glm::dvec3& p : level.mesh.positions) EXPECT_TRUE(before.count({p.x, p.y, p.z}));
  }
  for (const LodMesh& level : set.levels)
    EXPECT_EQ(level.mesh.morphTargets.size(), level.mesh.positions.size());
}

TEST(SimplifiedChain, OfASphereHasTheAskedCountsAndGrowingErrors) {
  const Mesh mesh = sphere(glm::dvec3(0.0), 1.0, 32);
  const LodSet set = simplifiedChain("ball", mesh, {0.5, 0.2, 0.05}, ChainNormals::Kept);
  expectChain(set, mesh, {0.5, 0.2, 0.05}, 0.02);
  for (const LodMesh& level : set.levels) {
    EXPECT_TRUE(checks::closedManifold(level.mesh, 0, level.mesh.triangles.size()));
    // Kept vertices lie on the sphere, so a chord's sagitta is all of the error: a triangle with edges e has
    // at most about e^2 / 6 (its circumcircle's radius squared over 2, e / sqrt(3) for the best shape) times
    // a few for bad shapes.
    const double edge =
        std::sqrt(4.0 * M_PI / static_cast<double>(level.mesh.triangles.size()) * 4.0 / std::sqrt(3.0));
    EXPECT_LT(level.deviation, 4.0 * edge * edge / 6.0);
  }
}

TEST(SimplifiedChain, MorphTargetsLieOnTheNextLevel) {
  const Mesh mesh = sphere(glm::dvec3(0.0), 1.0, 12);
  const LodSet set = simplifiedChain("ball", mesh, {0.4, 0.1});
  for (size_t i = 0; i + 1 < set.levels.size(); ++i) {
    const ClosestPoint coarser(set.levels[i + 1].mesh);
    for (const glm::dvec3& target : set.levels[i].mesh.morphTargets)
      EXPECT_LT(coarser.distance(target), 1e-12);
  }
  EXPECT_EQ(set.levels.back().mesh.morphTargets, set.levels.back().mesh.positions);
}

TEST(SimplifiedChain, OfInstalledModelsReachesWhatTheStudyUsed) {
  if (!fixtures::installed("bunny")) GTEST_SKIP() << "the package glmark2-data is not installed";
  for (const double reduction : {0.03, 0.88}) {
    const Scene scene = build("lod/object", {{"levels.count", int64_t{2}}, {"levels.reduction", reduction}});
    const LodObject& object = scene.lodObjects[0];
    ASSERT_EQ(object.levels.size(), 2U);
    EXPECT_NEAR(1.0 - double(object.levels[1].triangleCount) / object.levels[0].triangleCount, reduction,
                0.01);
    // Of height 1; a level with a tenth of the triangles is still a bunny.
    EXPECT_LT(object.levels[1].deviation, 0.05);
    EXPECT_GT(object.levels[1].deviation, 0.0);
  }
}

TEST(SimplifiedChain, LeavesOutWhatCannotBeSimplified) {
  const LodSet set = simplifiedChain("one", card(glm::dvec3(0.0), {1, 0, 0}, {0, 1, 0}), {0.9, 0.5, 0.1});
  EXPECT_LE(set.levels.size(), 2U);
  EXPECT_FALSE(set.levels.empty());
}

TEST(LodScenes, CarryObjectsApartFromTheirBackground) {
  const Scene scene = build("lod/mesh", {{"objects.count", int64_t{5}}, {"scale", 3.0}, {"offset", 2.0}});
  EXPECT_TRUE(scene.traits().count("lod_sets"));
  ASSERT_EQ(scene.lodObjects.size(), 5U);
  for (const LodObject& object : scene.lodObjects) {
    EXPECT_NEAR(object.bounds.high.y - object.bounds.low.y, 3.0, 0.01);
    for (int level = 0; level < static_cast<int>(object.levels.size()); ++level) {
      LodSelection alone{std::vector<int>(5, LodSelection::kOmitted), false};
      alone.levels[static_cast<size_t>(&object - scene.lodObjects.data())] = level;
      const Bounds bounds = withLevels(scene, alone).bounds();
      EXPECT_GE(lowest(bounds.low - object.bounds.low), -1e-9);
      EXPECT_GE(lowest(object.bounds.high - bounds.high), -1e-9);
      EXPECT_LT(glm::length(bounds.centre() - object.bounds.centre()), 0.1);
    }
    for (double distance : object.switchDistances) EXPECT_GE(distance, 3.0 * 4.0);
  }
}

/// One object of radius about 1 at the origin with levels whose errors are set by hand.
Scene byHand() {
  LodSet set;
  set.name = "ball";
  for (const double error : {0.0, 0.01, 0.1})
    set.levels.push_back({sphere(glm::dvec3(0.0), 1.0, 4), error, error});
  Scene scene;
  addLodObject(scene, set, {}, {"ball", glm::vec3(0.5F)}, {4.0, 8.0});
  return scene;
}

LodView viewFrom(double distance) {
  Camera camera;
  camera.eye = {0.0, 0.0, distance};
  camera.target = {0.0, 0.0, distance - 1.0};
  camera.verticalFovDeg = 90.0;  // 50 px a unit at distance 1
  return {camera, 100};
}

TEST(LodControl, DistanceSwitchesExactlyWhereStatedInBothDirections) {
  const Scene scene = byHand();
  const auto at = [&](double distance, double factor = 1.0) {
    return levelsByDistance(scene, viewFrom(distance), factor).levels[0];
  };
  EXPECT_EQ(at(4.0 - 1e-9), 0);
  EXPECT_EQ(at(4.0), 1);
  EXPECT_EQ(at(8.0 - 1e-9), 1);
  EXPECT_EQ(at(8.0), 2);
  EXPECT_EQ(at(1e9), 2);
  EXPECT_EQ(at(0.0), 0);
  EXPECT_EQ(at(8.0, 2.0), 1);
  // No memory: the same way out and back.
  for (double distance = 1.0; distance < 10.0; distance += 0.37)
    EXPECT_EQ(at(distance), distance < 4.0 ? 0 : distance < 8.0 ? 1 : 2);
}

TEST(LodControl, ScreenErrorIsThePinholeProjectionOfTheDeviation) {
  const Scene scene = byHand();
  // Deviation 0.1 seen at distance 11 - 1 from the box's near face, 50 px a unit at distance 1.
  EXPECT_NEAR(screenErrorPx(scene.lodObjects[0], 2, viewFrom(11.0)), 50.0 * 0.1 / 10.0, 1e-9);
  EXPECT_EQ(screenErrorPx(scene.lodObjects[0], 0, viewFrom(11.0)), 0.0);
  EXPECT_TRUE(std::isinf(screenErrorPx(scene.lodObjects[0], 1, viewFrom(0.5))));
  EXPECT_EQ(levelsByScreenError(scene, viewFrom(11.0 + 1e-6), 0.5).levels[0], 2);
  EXPECT_EQ(levelsByScreenError(scene, viewFrom(11.0 - 1e-6), 0.5).levels[0], 1);
  EXPECT_EQ(levelsByScreenError(scene, viewFrom(1.9), 0.5).levels[0], 0);
  EXPECT_EQ(levelsByScreenError(scene, viewFrom(0.5), 0.5).levels[0], 0);
  for (double distance = 1.5; distance < 40.0; distance *= 1.1) {
    const LodView view = viewFrom(distance);
    EXPECT_LE(largestScreenErrorPx(scene, levelsByScreenError(scene, view, 0.5), view), 0.5);
  }
}

TEST(LodControl, ScreenExtentIsTheSpheresSilhouette) {
  const Scene scene = byHand();
  const double radius = 0.5 * scene.lodObjects[0].bounds.diagonal(), distance = 5.0;
  // Tangent of the angle to the silhouette: tan(asin(r / d)).
  EXPECT_NEAR(screenExtentPx(scene.lodObjects[0], viewFrom(distance)),
              2.0 * 50.0 * std::tan(std::asin(radius / distance)), 1e-9);
  EXPECT_TRUE(std::isinf(screenExtentPx(scene.lodObjects[0], viewFrom(0.1))));
  int before = 0;
  for (double d = 1.0; d < 200.0; d *= 1.05) {
    const double extent = screenExtentPx(scene.lodObjects[0], viewFrom(d));
    const int level = levelsByScreenExtent(scene, viewFrom(d), 40.0, 0.5).levels[0];
    EXPECT_EQ(level, extent >= 40.0 ? 0 : extent >= 20.0 ? 1 : 2);
    EXPECT_GE(level, before);
    before = level;
  }
}

}  // namespace
}  // namespace limen::scene
