// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/light.h"

#include <gtest/gtest.h>

#include <numbers>

#include "experiments/base/error.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

using Polygon = std::vector<glm::dvec2>;

/// L: the unit square without its upper right quarter.
const Polygon kL = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 0.5}, {0.5, 0.5}, {0.5, 1.0}, {0.0, 1.0}};

AreaLight polygonLight(Polygon outline) {
  AreaLight light;
  light.shape = LightShape::Polygon;
  light.outline = std::move(outline);
  return light;
}

bool refused(const AreaLight& light) {
  try {
    checkLight(light, "here");
  } catch (const Error& error) {
    EXPECT_EQ(error.where(), "here");
    EXPECT_FALSE(error.hint().empty());
    return true;
  }
  return false;
}

/// Share of a fine grid that the light contains, times the rectangle: its area up to the boundary cells.
double sampledArea(const AreaLight& light) {
  constexpr int kGrid = 1000;
  int inside = 0;
  for (int j = 0; j < kGrid; ++j)
    for (int i = 0; i < kGrid; ++i) inside += light.contains({(i + 0.5) / kGrid, (j + 0.5) / kGrid});
  return light.size.x * light.size.y * inside / (double{kGrid} * kGrid);
}

TEST(AreaLight, AreaIsThatOfTheShape) {
  AreaLight light;
  light.size = {2.0, 0.5};
  EXPECT_EQ(light.area(), 1.0);
  light.shape = LightShape::Disc;
  EXPECT_NEAR(light.area(), std::numbers::pi * 1.0 * 0.25, 1e-15);  // half axes 1 and 1/4
  EXPECT_NEAR(sampledArea(light), light.area(), 2e-3);
  light = polygonLight(kL);
  light.size = {2.0, 0.5};
  EXPECT_NEAR(light.area(), 0.75, 1e-15);
  EXPECT_NEAR(sampledArea(light), 0.75, 2e-3);
}

TEST(AreaLight, ContainsItsBoundary) {
  AreaLight light;
  EXPECT_TRUE(light.contains({0.0, 1.0}));
  EXPECT_FALSE(light.contains({-1e-300, 0.5}));
  EXPECT_FALSE(light.contains({0.5, std::nextafter(1.0, 2.0)}));
  light.shape = LightShape::Disc;
  EXPECT_FALSE(light.contains({0.0, 0.0}));
  for (int i = 0; i < 1000; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 1000.0;
    EXPECT_TRUE(light.contains({0.5 + 0.5 * std::cos(angle), 0.5 + 0.5 * std::sin(angle)})) << i;
    EXPECT_FALSE(light.contains({0.5 + 0.5001 * std::cos(angle), 0.5 + 0.5001 * std::sin(angle)})) << i;
  }
  light = polygonLight({{0.1, 0.0}, {0.9, 0.3}, {0.4, 0.8}});
  for (size_t k = 0; k < 3; ++k)
    for (int i = 0; i <= 100; ++i)
      EXPECT_TRUE(light.contains(glm::mix(light.outline[k], light.outline[(k + 1) % 3], i / 100.0)))
          << k << " " << i;
  EXPECT_FALSE(light.contains({std::nan(""), 0.5}));
}

TEST(PolygonContains, KnowsTheNotchOfAConcavePolygon) {
  EXPECT_TRUE(polygonContains(kL, {0.25, 0.75}));
  EXPECT_TRUE(polygonContains(kL, {0.75, 0.25}));
  EXPECT_FALSE(polygonContains(kL, {0.75, 0.75}));
  EXPECT_TRUE(polygonContains(kL, {0.5, 0.75}));  // inner edge
  EXPECT_TRUE(polygonContains(kL, {0.5, 0.5}));   // inner corner
  EXPECT_FALSE(polygonContains(kL, {0.5 + 1e-14, 0.75}));
  // Level with vertices, where counting crossings goes wrong most easily.
  EXPECT_FALSE(polygonContains(kL, {-0.5, 0.5}));
  EXPECT_FALSE(polygonContains(kL, {1.5, 0.5}));
  EXPECT_FALSE(polygonContains(kL, {-0.5, 0.0}));
  EXPECT_FALSE(polygonContains(kL, {1.5, 1.0}));
}

TEST(PolygonContains, AgreesWithHalfPlanesOnAConvexPolygon) {
  const Polygon hexagon = lightOutline(withShape({}, LightShape::Polygon));
  ASSERT_EQ(hexagon.size(), 6U);
  for (int j = 0; j <= 64; ++j)
    for (int i = 0; i <= 64; ++i) {
      const glm::dvec2 p(i / 64.0, j / 64.0);
      // All numbers are small multiples of 1/64, so this is exact.
      bool inside = true;
      for (size_t k = 0; k < 6; ++k) {
        const glm::dvec2 edge = hexagon[(k + 1) % 6] - hexagon[k], to = p - hexagon[k];
        inside = inside && edge.x * to.y - edge.y * to.x >= 0.0;
      }
      EXPECT_EQ(polygonContains(hexagon, p), inside) << p.x << " " << p.y;
    }
}

TEST(LightOutline, IsCounterClockwiseWithTheShapesArea) {
  AreaLight light;
  EXPECT_EQ(signedArea(lightOutline(light)), 1.0);
  EXPECT_NEAR(signedArea(lightOutline(polygonLight(kL))), 0.75, 1e-15);
  light.shape = LightShape::Disc;
  // Regular n-gon of circumradius 1/2.
  EXPECT_NEAR(signedArea(lightOutline(light, 12)), 12.0 / 8.0 * std::sin(std::numbers::pi / 6.0), 1e-14);
  for (const glm::dvec2 vertex : lightOutline(light)) EXPECT_TRUE(light.contains(vertex));
}

TEST(CheckLight, RefusesWhatIsDegenerate) {
  EXPECT_FALSE(refused({}));
  EXPECT_FALSE(refused(polygonLight(kL)));
  EXPECT_TRUE(refused(polygonLight({})));
  EXPECT_TRUE(refused(polygonLight({{0.0, 0.0}, {1.0, 1.0}})));
  EXPECT_TRUE(refused(polygonLight({{0.0, 0.0}, {0.5, 0.5}, {1.0, 1.0}})));              // no area
  EXPECT_TRUE(refused(polygonLight({{0.0, 0.0}, {0.0, 1.0}, {1.0, 1.0}})));              // clockwise
  EXPECT_TRUE(refused(polygonLight({{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {1.0, 1.0}})));  // bow tie
  EXPECT_TRUE(refused(polygonLight({{0.0, 0.0}, {1.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}})));  // repeated vertex
  EXPECT_TRUE(refused(polygonLight({{0.0, 0.0}, {1.5, 0.0}, {0.0, 1.0}})));  // leaves the unit square
  EXPECT_TRUE(refused(polygonLight({{0.0, 0.0}, {1.0, 0.0}, {0.5, 0.0}, {0.0, 1.0}})));  // spike
  EXPECT_TRUE(refused(polygonLight({{0.0, 0.0}, {std::nan(""), 0.0}, {0.0, 1.0}})));
  AreaLight light;
  light.size.x = 0.0;
  EXPECT_TRUE(refused(light));
  light = {};
  light.axisX = {1.0, 0.1, 0.0};
  EXPECT_TRUE(refused(light));
  light = {};
  light.parts.clear();
  EXPECT_TRUE(refused(light));
  light = {};
  light.parts[0].radiance.g = -1.0F;
  EXPECT_TRUE(refused(light));
  light = {};
  light.parts[0].outline = {{0.0, 0.0}, {0.0, 1.0}, {1.0, 1.0}};
  EXPECT_TRUE(refused(light));
}

TEST(WithShape, KeepsTheExtents) {
  AreaLight light;
  light.size = {3.0, 2.0};
  for (const LightShape shape : {LightShape::Rectangle, LightShape::Disc, LightShape::Polygon}) {
    const AreaLight other = withShape(light, shape);
    EXPECT_EQ(other.size, light.size);
    EXPECT_FALSE(refused(other));
    Bounds bounds;
    for (const glm::dvec2 vertex : lightOutline(other)) bounds.extend(glm::dvec3(vertex, 0.0));
    EXPECT_NEAR(glm::length(bounds.low), 0.0, 1e-15);
    EXPECT_NEAR(glm::length(bounds.high - glm::dvec3(1.0, 1.0, 0.0)), 0.0, 1e-15);
  }
}

TEST(AreaLight, LightSpaceHasItsOriginAtTheCentreAndLooksAlongZ) {
  const AreaLight light = lightTowards({3.0, 4.0, -1.0}, {0.5, 0.0, 0.25}, {0.4, 0.6});
  const glm::dvec3 anchor(10.0, -20.0, 30.0);
  const glm::dmat4 matrix = light.toLightSpace(anchor);
  const auto map = [&](glm::dvec3 world) { return glm::dvec3(matrix * glm::dvec4(world - anchor, 1.0)); };
  EXPECT_NEAR(glm::length(map(light.centre)), 0.0, 1e-12);
  const double distance = glm::length(glm::dvec3(2.5, 4.0, -1.25));
  EXPECT_NEAR(glm::length(map({0.5, 0.0, 0.25}) - glm::dvec3(0.0, 0.0, distance)), 0.0, 1e-12);
  EXPECT_NEAR(glm::length(map(light.point({1.0, 0.0})) - glm::dvec3(0.2, -0.3, 0.0)), 0.0, 1e-12);
  EXPECT_NEAR(glm::determinant(matrix), 1.0, 1e-12);
}

}  // namespace
}  // namespace limen::scene
