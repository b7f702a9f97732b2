// SPDX-License-Identifier: BSD-3-Clause
// Ambient occlusion from fields against closed forms, and against the same rays traced.
#include <cmath>

#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "tests/renderer/techniques/technique_fixture.h"
#include "tests/renderer/visibility_fields/two_balls.h"

namespace limen::techniques {
namespace {

constexpr glm::ivec2 kSizePx{40, 30};
constexpr const char *kField = "visibility_fields/ambient_occlusion",
                     *kTraced = "visibility_fields/traced_occlusion";

class FieldOcclusionTest : public TechniqueTest {
 protected:
  static glm::dvec3 groundPoint(int x, int y) {
    const double half = 0.4 * std::tan(glm::radians(30.0));
    return {(2.0 * (x + 0.5) / kSizePx.x - 1.0) * half * kSizePx.x / kSizePx.y, 0.0,
            (2.0 * (y + 0.5) / kSizePx.y - 1.0) * half};
  }
  static double meanOf(const Image& image) {
    double sum = 0.0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) sum += image.at(x, y);
    return sum / (double(image.width) * image.height);
  }
};

/// A ball above the horizon hides sin^2 of its angular radius times the cosine of its middle (Nusselt's
/// analogue).
double hiddenBy(glm::dvec3 ball, glm::dvec3 point) {
  const glm::dvec3 d = ball - point;
  return kBall * kBall / glm::dot(d, d) * glm::normalize(d).y;
}

// The two balls are nowhere behind each other as seen from the ground below. Traced: 1024 rays in as many
// cells; those that the outline of a ball cuts, an ellipse in the unit disc of length below 2 pi 0.35, pi /
// 32^2 each, number below 2 * 2.2 * 32 / 1.77
// * 1.5 = 120 for both, and each may count either way; as good as independent, 3 deviations are 3 * 0.5 *
// sqrt(120) / 1024 = 0.016. Meshed balls lose up to 1 - cos(pi / 96) = 5e-4 of their radius. Fields: an
// outline is moved by less than the distance between positions, 0.04 radii of 1, and a texel, 4 / (pi 64) at
// a distance up to 2: 0.08, by which a ball of 0.3 gains or loses up to 2 * 0.08 / 0.3 of its 0.17 together.
// On average over the picture gains and losses cancel, to a tenth.
TEST_F(FieldOcclusionTest, BallsHideWhatTheirSolidAnglesSay) {
  const scene::Scene scene = twoBallsOverGround();
  for (const bool traced : {true, false}) {
    Given given = {{"rays", int64_t{1024}}, {"radius", 10.0}};
    if (!traced)
      given.insert({{"positions", int64_t{4226}},
                    {"directions", int64_t{64}},
                    {"combine.near", std::string("field")}});
    const Image image = render(scene, traced ? kTraced : kField, given, kSizePx).product;
    double sum = 0.0;
    for (int y = 0; y < kSizePx.y; ++y)
      for (int x = 0; x < kSizePx.x; ++x) {
        const glm::dvec3 p = groundPoint(x, y);
        const double hidden = hiddenBy(kFirstBall, p) + hiddenBy(kSecondBall, p);
        ASSERT_NEAR(image.at(x, y), 1.0 - hidden, 0.017 + (traced ? 0.0 : 0.53 * hidden)) << x << ' ' << y;
        sum += image.at(x, y) - (1.0 - hidden);
      }
    EXPECT_LT(std::abs(sum / (kSizePx.x * kSizePx.y)), traced ? 0.002 : 0.01);
  }
}

// Errors of the thesis's fetch against the same rays fall with positions (Gaitatzes 2012, Fig. 35).
TEST_F(FieldOcclusionTest, ErrorFallsWithPositions) {
  const scene::Scene scene = twoBallsOverGround();
  // As one object: around a ball alone its sphere errs no more with few positions than with many.
  const Given rays = {{"rays", int64_t{256}}, {"radius", 10.0}, {"objects", std::string("parts")}};
  const Image exact = render(scene, kTraced, rays, kSizePx).product;
  double before = 1.0;
  for (const int64_t positions : {82, 290, 1090, 4226}) {
    Given given = rays;
    given["combine.near"] = std::string("field");
    given["fetch"] = std::string("nearest");
    given["positions"] = positions;
    const double error = meanDifference(render(scene, kField, given, kSizePx).product, exact);
    // Four times the positions: half the distance between them.
    EXPECT_LT(error, 0.8 * before) << positions;
    before = error;
  }
}

// Aimed rays err by their directions: each time half as far apart, from 1090 positions.
TEST_F(FieldOcclusionTest, ErrorOfAimedRaysFallsWithDirections) {
  const scene::Scene scene = twoBallsOverGround();
  Given given = {{"rays", int64_t{256}}, {"radius", 10.0}, {"objects", std::string("parts")}};
  const Image exact = render(scene, kTraced, given, kSizePx).product;
  given.insert({{"positions", int64_t{1090}},
                {"fetch", std::string("aimed")},
                {"combine.near", std::string("field")}});
  double before = 1.0;
  for (const int64_t directions : {8, 16, 32, 64}) {
    given["directions"] = directions;
    const double error = meanDifference(render(scene, kField, given, kSizePx).product, exact);
    EXPECT_LT(error, 0.8 * before) << directions;
    before = error;
  }
}

// Aimed at the middle of its sphere, a ray from a position beside its own misses its own place there by
// nothing in place of the distance between positions, and by as much only where it leaves the sphere: on
// average half as much. Of three positions a part of what is left cancels. Neither rays nor storage differ.
TEST_F(FieldOcclusionTest, AimedRaysErrLessThanParallelOnes) {
  const scene::Scene scene = twoBallsOverGround();
  Given given = {{"rays", int64_t{256}}, {"radius", 10.0}, {"objects", std::string("parts")}};
  const Image exact = render(scene, kTraced, given, kSizePx).product;
  given.insert(
      {{"positions", int64_t{1090}}, {"directions", int64_t{64}}, {"combine.near", std::string("field")}});
  double before = 1.0;
  for (const char* fetch : {"nearest", "aimed", "positions"}) {
    given["fetch"] = std::string(fetch);
    const double error = meanDifference(render(scene, kField, given, kSizePx).product, exact);
    EXPECT_LT(error, before) << fetch;
    before = error;
  }
}

// Receivers that are not the object's own need no slack: on the ground, within the sphere of a box that
// stands on it, slack changes nothing.
TEST_F(FieldOcclusionTest, ReceiversOfOtherObjectsHaveNoSlack) {
  scene::Scene scene;
  scene::addGround(scene, 8.0);
  scene::addPart(scene, "box", scene::box({-0.5, 0.0, -0.5}, {0.5, 1.0, 0.5}), glm::vec3(0.5F));
  scene::setStillCamera(scene, {{1.2, 0.8, 0.0}, {0.6, 0.0, 0.0}, {0.0, 1.0, 0.0}, 30.0});
  Given given = {{"rays", int64_t{64}},
                 {"radius", 10.0},
                 {"self_occlusion", false},
                 {"combine.near", std::string("field")}};
  given["positions"] = int64_t{1090};
  const Image without = render(scene, kField, given, kSizePx).product;
  given["slack"] = 20.0;
  EXPECT_EQ(meanDifference(without, render(scene, kField, given, kSizePx).product), 0.0);
}

TEST_F(FieldOcclusionTest, NeighboursAreKnownOnALatticeOfConcentricMaps) {
  for (const char* fetch : {"positions", "all"})
    EXPECT_TRUE(refusal(kField, {{"fetch", std::string(fetch)}, {"position_map", std::string("grid")}}));
  EXPECT_FALSE(refusal(kField, {{"fetch", std::string("aimed")}, {"position_map", std::string("grid")}}));
}

// The same object twice: the nearest hit knows that they hide each other, products and sums do not.
TEST_F(FieldOcclusionTest, CombinesObjectsAsItSays) {
  const scene::Scene one = twoBallsOverGround();
  scene::Scene two = twoBallsOverGround();
  scene::addPart(two, "again", ballMeshes(), glm::vec3(0.5F));
  const Given given = {{"rays", int64_t{64}},
                       {"radius", 10.0},
                       {"positions", int64_t{290}},
                       {"objects", std::string("parts")}};
  const Image single = render(one, kField, given, kSizePx).product;
  ASSERT_LT(meanOf(single), 0.95);
  for (const std::string combine : {"nearest", "product", "subtract", "passes"}) {
    Given both = given;
    both["combine"] = combine;
    const Image image = render(two, kField, both, kSizePx).product;
    for (int y = 0; y < kSizePx.y; ++y)
      for (int x = 0; x < kSizePx.x; ++x) {
        const double a = single.at(x, y);
        const double expected = combine == "nearest"   ? a
                                : combine == "product" ? a * a
                                                       : std::max(0.0, 2.0 * a - 1.0);
        ASSERT_NEAR(image.at(x, y), expected, 1e-5) << combine;
      }
  }
}

// At a wall that is part of the same object: beside a wall of height h at the distance d (1 - d / sqrt(d^2 +
// h^2)) / 2 is hidden. Floor and wall lie in a sphere of radius 2.3; a position is up to 0.04 of it away and
// a texel 4 / (pi 64) at up to 4.6, which moves the wall's top by up to 0.18 and what it hides by up to 0.15
// of that, 0.027. The floor's own share is as much as a convex object may hide of itself, 0.03 below. Single
// pixels may err twice as much as the mean, as positions are the same for whole areas.
TEST_F(FieldOcclusionTest, AnObjectOccludesItself) {
  scene::Scene scene;
  scene::Mesh corner = scene::box({0.0, -0.1, -2.0}, {2.0, 0.0, 2.0});
  scene::append(corner, scene::box({-0.1, -0.1, -2.0}, {0.0, 1.0, 2.0}));
  scene::addPart(scene, "corner", corner, glm::vec3(0.5F));
  scene::setStillCamera(scene, {{1.0, 1.5, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, 20.0});
  const Given given = {{"rays", int64_t{1024}}, {"radius", 10.0}, {"objects", std::string("parts")}};
  const Image traced = render(scene, kTraced, given, kSizePx).product;
  Given fine = given;
  fine.insert(
      {{"positions", int64_t{4226}}, {"directions", int64_t{64}}, {"combine.near", std::string("field")}});
  const Image found = render(scene, kField, fine, kSizePx).product;
  fine["self_occlusion"] = false;
  const Image without = render(scene, kField, fine, kSizePx).product;
  for (int y = 0; y < kSizePx.y; ++y)
    for (int x = 0; x < kSizePx.x; ++x) {
      const double d = 1.0 + (2.0 * (x + 0.5) / kSizePx.x - 1.0) * 1.5 * std::tan(glm::radians(10.0)) *
                                 kSizePx.x / kSizePx.y;
      const double hidden = 0.5 * (1.0 - d / std::hypot(d, 1.0));
      // The wall's ends, 2 away to both sides, leave open less than what a wall of its height would hide
      // there: 0.053, at most half of it towards the wall. Rays as above: outline below 2 long, 60 cells.
      ASSERT_NEAR(traced.at(x, y), 1.0 - hidden, 0.012 + 0.05) << d;
      ASSERT_NEAR(found.at(x, y), traced.at(x, y), 0.12) << d;
      ASSERT_EQ(without.at(x, y), 1.0F);
    }
  EXPECT_LT(meanDifference(found, traced), 0.06);
}

// A box is convex, and nothing else is there: what is dark is acne. More slack cannot add to it, and from one
// spacing on it is what an eye does not see in a smooth picture, 3 %.
TEST_F(FieldOcclusionTest, SlackKeepsAConvexObjectFromOccludingItself) {
  scene::Scene scene;
  scene::addPart(scene, "box", scene::box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}), glm::vec3(0.5F));
  scene::setStillCamera(scene, scene::orbitCamera({0.0, 0.0, 0.0}, 3.0, 30.0, 30.0));
  Given given = {{"rays", int64_t{64}},
                 {"radius", 10.0},
                 {"positions", int64_t{4226}},
                 {"combine.near", std::string("field")}};
  EXPECT_EQ(meanOf(render(scene, kTraced, {{"rays", int64_t{64}}, {"radius", 10.0}}, kSizePx).product), 1.0);
  double before = 0.0;
  for (const double slack : {0.0, 0.5, 1.0, 2.0}) {
    given["slack"] = slack;
    const double open = meanOf(render(scene, kField, given, kSizePx).product);
    EXPECT_GE(open, before);
    before = open;
    if (slack >= 1.0) {
      EXPECT_GT(open, 0.97) << slack;
    }
  }
}

// Beside a box on the ground: a wall of height h at the distance d, much longer than d, hides (1 - d /
// sqrt(d^2 + h^2)) / 2 (view factor of a strip). Looked up, receivers nearer than a footprint know nothing of
// the wall's foot; traced, they are as exact as their rays: 1024 cells, of which the wall's top cuts up to 2
// * 32 / 1.77 * 1.5 = 54, 3 * 0.5 * sqrt(54) / 1024 = 0.011, and each end of the wall, 2 away, leaves open
// less than 0.002 of it.
TEST_F(FieldOcclusionTest, ReceiversNearAnObjectAreTraced) {
  scene::Scene scene;
  scene::addGround(scene, 16.0);
  scene::addPart(scene, "box", scene::box({-0.5, 0.0, -2.0}, {0.0, 0.1, 2.0}), glm::vec3(0.5F));
  // 0.03 across.
  scene::setStillCamera(scene, {{0.0161, 0.05, 0.0}, {0.0161, 0.0, 0.0}, {0.0, 0.0, -1.0}, 25.0});
  Given given = {{"rays", int64_t{1024}}, {"radius", 10.0}, {"self_occlusion", false}};
  double worst[2] = {0.0, 0.0};
  for (const bool traced : {false, true}) {
    given["combine.near"] = std::string(traced ? "traced" : "field");
    const Rendered found = render(scene, kField, given, kSizePx, true);
    for (int y = 0; y < kSizePx.y; ++y)
      for (int x = 0; x < kSizePx.x; ++x) {
        const double d = 0.0161 + (2.0 * (x + 0.5) / kSizePx.x - 1.0) * 0.05 * std::tan(glm::radians(12.5)) *
                                      kSizePx.x / kSizePx.y;
        const double hidden = 0.5 * (1.0 - d / std::hypot(d, 0.1));
        worst[traced] = std::max(worst[traced], std::abs(found.product.at(x, y) - (1.0 - hidden)));
      }
    EXPECT_EQ(found.counter("near_share"), traced ? 1.0 : 0.0);
  }
  EXPECT_LT(worst[1], 0.013);
  EXPECT_GT(worst[0], 4.0 * worst[1]);
}

// Within the sphere of a tall box a ray that goes up into it leaves by the roof, far beyond the falloff's
// radius: the way back from the sphere tells of the roof alone, the way from behind the ground of the bottom,
// which counts. A box that floats at the height g hides from the ground's point below its middle, within a
// radius that holds its bottom, what the bottom does: of a square of half-width a 4 / (2 pi) * 2 * X / sqrt(1
// + X^2) * atan(X / sqrt(1 + X^2)), X = a / g, the view factor of four corners. Rays, turned for each pixel,
// lie on 16 rings about the normal, of up to 0.12 of them each: the outline, at sines of 0.83 to 0.90, wider
// than a ring, is found to a third of half of one, 0.02. Fields of 4226 x 64 x 64 move it, 0.72 to 0.94 away,
// by up to half a footprint, 0.04 * 1.04, at a cosine of 0.5: 0.03 of the half space.
TEST_F(FieldOcclusionTest, WhatBlocksFirstCountsAndNotWhatIsBehindIt) {
  scene::Scene scene;
  scene::addGround(scene, 8.0);
  constexpr double kHalf = 0.6,
                   kGap = 0.4;  // the ground is within its sphere, of radius 1.04 about a height of 1
  scene::addPart(scene, "box", scene::box({-kHalf, kGap, -kHalf}, {kHalf, kGap + 1.2, kHalf}),
                 glm::vec3(0.5F));
  scene::setStillCamera(scene, {{0.0, 0.2, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, 5.0});
  const double x = kHalf / kGap, root = std::sqrt(1.0 + x * x);
  const double hidden = 4.0 / (2.0 * M_PI) * 2.0 * x / root * std::atan(x / root);
  const double diagonal = frame::GpuScene(scene).diagonal();
  // Beyond the bottom's corners, sqrt(0.88) away, and short of the roof.
  Given given = {{"rays", int64_t{1024}},
                 {"radius", 1.0 / diagonal},
                 {"self_occlusion", false},
                 {"pattern", std::string("turned")},
                 {"positions", int64_t{4226}},
                 {"directions", int64_t{64}},
                 {"combine.near", std::string("field")}};
  EXPECT_NEAR(meanOf(render(scene, kTraced,
                            {{"rays", int64_t{1024}},
                             {"radius", 1.0 / diagonal},
                             {"self_occlusion", false},
                             {"pattern", std::string("turned")}},
                            kSizePx)
                         .product),
              1.0 - hidden, 0.02);
  EXPECT_NEAR(meanOf(render(scene, kField, given, kSizePx).product), 1.0 - hidden, 0.05);
  // The thesis's look-up knows where a ray leaves the box alone: steeper ones than 0.6 / 1, a share 0.36 of
  // the half space, do so farther away.
  given["fetch"] = std::string("nearest");
  EXPECT_GT(meanOf(render(scene, kField, given, kSizePx).product), 1.0 - hidden + 0.3);
}

TEST_F(FieldOcclusionTest, IsTheSameInEveryRunAndFarFromTheOrigin) {
  const Given given = {{"rays", int64_t{64}}, {"positions", int64_t{290}}};
  const scene::Scene here = makeScene("resting_sphere"),
                     there = makeScene("resting_sphere", {{"offset", 1e5}});
  const Image first = render(here, kField, given, kSizePx).product;
  EXPECT_EQ(meanDifference(first, render(here, kField, given, kSizePx).product), 0.0);
  // 1e5 diagonals away coordinates are known to 1e5 2^-53 of one: rays at the border of a texel may fall to
  // either side.
  EXPECT_LT(meanDifference(first, render(there, kField, given, kSizePx).product), 1e-3);
}

}  // namespace
}  // namespace limen::techniques
