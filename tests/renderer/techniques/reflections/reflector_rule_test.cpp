// SPDX-License-Identifier: BSD-3-Clause
// What is measured of reflectors, against shapes for which it is known, and what the rule makes of it.
#include <gmock/gmock.h>

#include <random>

#include "renderer/techniques/reflections/scene_needs/reflector_rule.h"
#include "tests/renderer/techniques/reflections/reflection_fixture.h"

namespace limen::techniques {
namespace {

using testing::HasSubstr;

class ReflectorFactsTest : public ReflectionTest {
 protected:
  static scene::Scene withMirror(const scene::Mesh& mesh, float glossRad = 0.0F) {
    scene::Scene scene;
    scene::Material material = mirrorMaterial(0.8F);
    material.glossRad = glossRad;
    addPart(scene, mesh, material);
    return scene;
  }
  static ReflectorFacts factsOf(const scene::Scene& scene, double creaseDeg = 10.0) {
    const std::vector<ReflectorFacts> all = measureReflectors(scene, creaseDeg);
    EXPECT_EQ(all.size(), 1U);
    return all.at(0);
  }
  /// An L of unit thickness and height 1 without vertex normals: 2 x 2 less the square x, z > 1.
  static scene::Mesh angle() {
    const std::vector<glm::dvec2> outline = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
    scene::Mesh mesh;
    for (const double y : {0.0, 1.0})
      for (const glm::dvec2& p : outline) mesh.positions.emplace_back(p.x, y, -p.y);
    for (uint32_t i = 0; i < 6; ++i) {
      const uint32_t j = (i + 1) % 6;
      mesh.triangles.insert(mesh.triangles.end(), {{i, j, 6 + j}, {i, 6 + j, 6 + i}});
    }
    for (const glm::uvec3 t : {glm::uvec3{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}) {
      mesh.triangles.push_back(t + glm::uvec3(6));
      mesh.triangles.emplace_back(t.x, t.z, t.y);
    }
    return mesh;
  }
};

TEST_F(ReflectorFactsTest, DistanceToATriangleIsTheLeastOfManyPoints) {
  std::mt19937 random(5);
  const auto point = [&] {
    std::uniform_real_distribution<double> one(-1.0, 1.0);
    return glm::dvec3(one(random), one(random), one(random));
  };
  constexpr int kSteps = 200;
  for (int round = 0; round < 40; ++round) {
    const glm::dvec3 p = 2.0 * point(), a = point(), b = point(), c = point();
    double least = 1e30;
    for (int i = 0; i <= kSteps; ++i)
      for (int j = 0; i + j <= kSteps; ++j)
        least = std::min(least,
                         glm::length(p - (a + (double(i) * (b - a) + double(j) * (c - a)) / double(kSteps))));
    const double found = distanceToTriangle(p, a, b, c);
    // Samples are points of the triangle, and none of its points is farther from one than half a cell's
    // sides.
    const double cell = (glm::length(b - a) + glm::length(c - a)) / kSteps;
    EXPECT_LE(found, least + 1e-12);
    EXPECT_GE(found, least - cell);
  }
  // Without area: the segment from (0, 0, 0) to (2, 0, 0), 3 away from (1, 3, 0).
  EXPECT_NEAR(distanceToTriangle({1, 3, 0}, {0, 0, 0}, {1, 0, 0}, {2, 0, 0}), 3.0, 1e-12);
}

TEST_F(ReflectorFactsTest, ASphereIsConvexSmoothAndNoPlane) {
  // A ball of radius 2 and a card of which the nearest point is its middle, 7 away: 3.5 radii.
  scene::Scene scene = withMirror(scene::sphere({1, 2, 3}, 2.0, 12));
  addPart(scene, "card", scene::card({1, 9, 3}, {1, 0, 0}, {0, 0, 1}), glm::vec3(0.5F));
  const ReflectorFacts facts = factsOf(scene);
  EXPECT_EQ(facts.planes, 8 * 12 * 12) << "facets, as it has no normals";
  EXPECT_EQ(facts.concaveShare, 0.0);
  EXPECT_EQ(facts.creasedShare, 0.0);
  EXPECT_TRUE(facts.star);
  EXPECT_NEAR(facts.surroundings, 3.5, 1e-9);
  EXPECT_EQ(facts.areaShare, 1.0);
  scene::Mesh smooth = scene::sphere({1, 2, 3}, 2.0, 12);
  smooth.normals.clear();
  for (const glm::dvec3& p : smooth.positions)
    smooth.normals.emplace_back(glm::normalize(p - glm::dvec3(1, 2, 3)));
  EXPECT_EQ(factsOf(withMirror(smooth)).planes, 0);
  EXPECT_EQ(factsOf(withMirror(smooth), 0.001).creasedShare, 0.0);
}

TEST_F(ReflectorFactsTest, NothingAroundIsInfinitelyFar) {
  EXPECT_TRUE(std::isinf(factsOf(withMirror(scene::sphere({0, 0, 0}, 1.0, 4))).surroundings));
}

TEST_F(ReflectorFactsTest, EdgesOfAnAngleAreCountedByLengthAndTurn) {
  // All turns are right angles. Concave: the inner vertical edge, 1 long. Convex: five vertical edges and
  // twice the outline's 8. Diagonals and the fans' inner edges do not turn.
  const ReflectorFacts facts = factsOf(withMirror(angle()));
  EXPECT_NEAR(facts.concaveShare, 1.0 / 22.0, 1e-12);
  // Creased are the 22 of those that turn; the others are the six sides' diagonals (sqrt 2, and sqrt 5 of the
  // two sides that are 2 long) and two fans' three edges from (0, 0): to (2, 1), (1, 1) and (1, 2).
  const double flat =
      4.0 * std::sqrt(2.0) + 2.0 * std::sqrt(5.0) + 2.0 * (std::sqrt(5.0) + std::sqrt(2.0) + std::sqrt(5.0));
  EXPECT_NEAR(facts.creasedShare, 22.0 / (22.0 + flat), 1e-12);
  EXPECT_EQ(facts.planes, 8);
  // Right angles are no creases to one who allows for more.
  EXPECT_EQ(factsOf(withMirror(angle()), 91.0).creasedShare, 0.0);
}

TEST_F(ReflectorFactsTest, ABowlIsConcave) {
  const ReflectorFacts facts = factsOf(withMirror([] {
    scene::Mesh mesh = scene::sphere({0, 0, 0}, 1.0, 8);
    for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
    for (glm::vec3& normal : mesh.normals) normal = -normal;
    return mesh;
  }()));
  EXPECT_NEAR(facts.concaveShare, 1.0, 1e-12);
  EXPECT_TRUE(facts.star);
}

TEST_F(ReflectorFactsTest, APlaneWithBentNormalsIsNone) {
  scene::Mesh mesh = scene::planeGrid({0, 0, 0}, 2.0, 2.0, 4);
  mesh.normals.assign(mesh.positions.size(), glm::vec3(0, 1, 0));
  EXPECT_EQ(factsOf(withMirror(mesh)).planes, 1);
  mesh.normals[7] = glm::normalize(glm::vec3(0.01F, 1.0F, 0.0F));
  EXPECT_EQ(factsOf(withMirror(mesh)).planes, 0);
}

TEST_F(ReflectorFactsTest, TrianglesWithoutAreaCountNowhere) {
  scene::Mesh mesh = scene::planeGrid({0, 0, 0}, 2.0, 2.0, 2);
  mesh.triangles.emplace_back(0, 0, 1);
  EXPECT_EQ(factsOf(withMirror(mesh)).planes, 1);
  scene::Mesh none;
  none.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  none.triangles = {{0, 1, 2}};
  EXPECT_TRUE(measureReflectors(withMirror(none), 10.0).empty());
  EXPECT_EQ(decideByRule({}, false, {}).all.need, ReflectorNeed::Tracer);
}

TEST_F(ReflectorFactsTest, SizeAndPlaceChangeNothing) {
  const ReflectorFacts before = factsOf(makeScene("mirrors/ball", {{"tessellation", int64_t{12}}}));
  for (const double scale : {1e-3, 1e3}) {
    const ReflectorFacts after =
        factsOf(makeScene("mirrors/ball", {{"tessellation", int64_t{12}}, {"scale", scale}}));
    EXPECT_NEAR(after.surroundings, before.surroundings, 1e-9);
    EXPECT_EQ(after.planes, before.planes);
    EXPECT_NEAR(after.concaveShare, before.concaveShare, 1e-9);
  }
}

/// What the rule takes for scenes that leave no doubt.
class ReflectorRuleTest : public ReflectorFactsTest {
 protected:
  static RuleVerdict decide(const scene::Scene& scene, bool moving) {
    const std::vector<ReflectorFacts> facts = measureReflectors(scene, ReflectorRule{}.creaseDeg);
    return decideByRule(facts, moving, {});
  }
  static ReflectorNeed need(const scene::Scene& scene, bool moving) { return decide(scene, moving).all.need; }
  /// A ball amid six walls at this distance from its middle, in radii.
  static scene::Scene ballInARoom(double distance) {
    scene::Scene scene = withMirror(scene::sphere({0, 0, 0}, 1.0, 8));
    addPart(scene, "walls", scene::box(glm::dvec3(-distance), glm::dvec3(distance)), glm::vec3(0.5F));
    return scene;
  }
};

TEST_F(ReflectorRuleTest, PlanesNeedPlanarMirrors) {
  for (const bool moving : {false, true}) {
    EXPECT_EQ(need(makeScene("mirrors/planes", {{"planes", int64_t{2}}}), moving),
              ReflectorNeed::PlanarMirror);
    EXPECT_EQ(decide(makeScene("mirrors/planes", {{"planes", int64_t{3}}}), moving).planes, 3);
  }
}

TEST_F(ReflectorRuleTest, DistantSurroundingsNeedAMap) {
  for (const bool moving : {false, true}) EXPECT_EQ(need(ballInARoom(30.0), moving), ReflectorNeed::Map);
  EXPECT_EQ(need(ballInARoom(10.0), false), ReflectorNeed::Tracer);
}

TEST_F(ReflectorRuleTest, WhatMovesDecidesBetweenRaysAndVertices) {
  EXPECT_EQ(need(makeScene("mirrors/ball"), false), ReflectorNeed::Tracer);
  EXPECT_EQ(need(makeScene("mirrors/ball"), true), ReflectorNeed::Vertices);
  EXPECT_EQ(need(ballInARoom(10.0), true), ReflectorNeed::Vertices);
}

TEST_F(ReflectorRuleTest, ConcaveOrCreasedMirrorsThatMoveNeedTheHierarchy) {
  EXPECT_EQ(need(makeScene("mirrors/sheet"), true), ReflectorNeed::RayHierarchy);
  scene::Scene angled = withMirror(angle());
  addPart(angled, "floor", scene::planeGrid({0, -0.1, 0}, 4.0, 4.0, 2), glm::vec3(0.5F));
  EXPECT_EQ(need(angled, true), ReflectorNeed::RayHierarchy);
  EXPECT_EQ(need(angled, false), ReflectorNeed::Tracer);
}

TEST_F(ReflectorRuleTest, GlossComesFirst) {
  const scene::Scene plane = withMirror(scene::planeGrid({0, 0, 0}, 2.0, 2.0, 2), 0.05F);
  const RuleVerdict verdict = decide(plane, false);
  EXPECT_EQ(verdict.all.need, ReflectorNeed::Cones);
  EXPECT_THAT(verdict.reflectors.at(0).reason, HasSubstr("glossy: 0.05 rad"));
  // A gloss that no pixel shows is none.
  EXPECT_EQ(need(withMirror(scene::planeGrid({0, 0, 0}, 2.0, 2.0, 2), 1e-4F), false),
            ReflectorNeed::PlanarMirror);
}

TEST_F(ReflectorRuleTest, MirrorsOfSeveralKindsNeedWhatServesAll) {
  scene::Scene scene = makeScene("mirrors/ball");
  addPart(scene, scene::card({0, 1, -3}, {1, 0, 0}, {0, 1, 0}), mirrorMaterial(0.5F));
  const RuleVerdict moving = decide(scene, true);
  ASSERT_EQ(moving.reflectors.size(), 2U);
  EXPECT_EQ(moving.reflectors[0].need, ReflectorNeed::Vertices);
  EXPECT_EQ(moving.reflectors[1].need, ReflectorNeed::PlanarMirror);
  EXPECT_EQ(moving.all.need, ReflectorNeed::RayHierarchy);
  EXPECT_EQ(need(scene, false), ReflectorNeed::Tracer);
}

}  // namespace
}  // namespace limen::techniques
