// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "renderer/scene/light.h"
#include "tests/renderer/scene/scene_fixtures.h"

namespace limen::scene {
namespace {

using fixtures::build;

TEST(CommonParameters, AreDeclaredAfterTheScenesOwn) {
  const SceneInfo& info = SceneRegistry::instance().get("card_stack");
  const std::vector<Parameter> all = info.allParameters();
  ASSERT_EQ(all.size(), info.parameters.size() + 5);
  EXPECT_EQ(all.front().name, "cards");
  EXPECT_EQ(all[info.parameters.size()].name, "scale");
}

TEST(BuildScene, TakesDefaultsForWhatIsLeftOut) {
  EXPECT_EQ(buildScene("two_boxes", {}).contentHash(), build("two_boxes").contentHash());
  EXPECT_EQ(buildScene("two_boxes", {}).name, "two_boxes");
}

TEST(BuildScene, NamesTheNearestSceneOrParameter) {
  const auto message = [](auto function) {
    try {
      function();
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(message([] { buildScene("two_boxs", {}); }), testing::HasSubstr("did you mean 'two_boxes'?"));
  EXPECT_THAT(message([] { buildScene("mesh", {}); }), testing::HasSubstr("'file' is missing"));
  EXPECT_THAT(message([] { build("two_boxes", {{"light_sise", 1.0}}); }), testing::HasSubstr("light_size"));
}

TEST(CommonParameters, ScaleMultipliesGeometryLightAndCamera) {
  const Scene plain = build("two_colour_light");
  for (const double scale : {1e-6, 3.0, 1e6}) {
    const Scene scaled = build("two_colour_light", {{"scale", scale}});
    ASSERT_EQ(scaled.mesh.positions.size(), plain.mesh.positions.size());
    for (size_t i = 0; i < plain.mesh.positions.size(); ++i)
      EXPECT_EQ(scaled.mesh.positions[i], scale * plain.mesh.positions[i]);
    EXPECT_EQ(scaled.mesh.triangles, plain.mesh.triangles);
    EXPECT_EQ(scaled.lights[0].centre, scale * plain.lights[0].centre);
    EXPECT_EQ(scaled.lights[0].size, scale * plain.lights[0].size);
    EXPECT_EQ(scaled.lights[0].axisX, plain.lights[0].axisX);
    EXPECT_EQ(scaled.camera.at(0.0).eye, scale * plain.camera.at(0.0).eye);
    EXPECT_EQ(scaled.camera.at(0.0).target, scale * plain.camera.at(0.0).target);
    EXPECT_EQ(scaled.camera.at(0.0).verticalFovDeg, plain.camera.at(0.0).verticalFovDeg);
  }
}

TEST(CommonParameters, OffsetMovesTheWorldByItsOwnDiagonals) {
  const Scene plain = build("two_boxes", {{"scale", 2.0}});
  for (const double offset : {1.0, 1e3, 1e6}) {
    const Scene moved = build("two_boxes", {{"scale", 2.0}, {"offset", offset}});
    const double distance = offset * plain.bounds().diagonal();
    // Positions are rounded at the distance they were moved to; sums of three roundings.
    const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * distance;
    const glm::dvec3 shift = glm::dvec3(distance / std::sqrt(3.0));
    for (size_t i = 0; i < plain.mesh.positions.size(); ++i)
      EXPECT_NEAR(glm::length(moved.mesh.positions[i] - plain.mesh.positions[i] - shift), 0.0, rounding);
    EXPECT_NEAR(glm::length(moved.lights[0].centre - plain.lights[0].centre), distance, rounding);
    EXPECT_NEAR(glm::length(moved.camera.at(0.0).eye - plain.camera.at(0.0).eye - shift), 0.0, rounding);
    EXPECT_NEAR(glm::length(moved.camera.at(0.0).target - plain.camera.at(0.0).target - shift), 0.0,
                rounding);
    EXPECT_EQ(moved.lights[0].size, plain.lights[0].size);
  }
}

TEST(CommonParameters, LightSizeMultipliesTheExtentsAlone) {
  const Scene plain = build("pole"), large = build("pole", {{"light_size", 2.5}});
  EXPECT_EQ(large.lights[0].size, 2.5 * plain.lights[0].size);
  EXPECT_NEAR(large.lights[0].area(), 6.25 * plain.lights[0].area(), 1e-12);
  EXPECT_EQ(large.lights[0].centre, plain.lights[0].centre);
  EXPECT_EQ(large.mesh.positions, plain.mesh.positions);
}

TEST(CommonParameters, LightShapeReplacesTheShapeWithinTheExtents) {
  const AreaLight rectangle = build("pole").lights[0];
  // Ellipse: pi/4 of its rectangle; hexagon that touches all sides: 3/4.
  const std::vector<std::pair<std::string, double>> shares = {
      {"rectangle", 1.0}, {"disc", std::acos(-1.0) / 4.0}, {"polygon", 0.75}};
  for (const auto& [shape, share] : shares) {
    const AreaLight light = build("pole", {{"light_shape", shape}}).lights[0];
    EXPECT_NEAR(light.area(), share * rectangle.area(), 1e-12) << shape;
    EXPECT_EQ(light.size, rectangle.size);
  }
}

TEST(CommonParameters, TimeMovesAlongTheCameraPath) {
  const std::string walk = "walk";
  const Scene path = build("columns_hall", {{"motion", walk}});
  EXPECT_TRUE(path.traits().count("moving_camera"));
  EXPECT_EQ(path.camera.keys.front().timeS, 0.0);
  for (const double time : {0.7, 3.5, 7.9, 60.0}) {
    const Scene later = build("columns_hall", {{"motion", walk}, {"camera.time_s", time}});
    for (const double t : {0.0, 0.4, 2.0})
      EXPECT_NEAR(glm::length(later.camera.at(t).eye - path.camera.at(time + t).eye), 0.0, 1e-12);
    EXPECT_NE(later.contentHash(), path.contentHash());
  }
  // A still camera knows no time.
  EXPECT_EQ(build("columns_hall", {{"camera.time_s", 3.0}}).contentHash(),
            build("columns_hall").contentHash());
}

}  // namespace
}  // namespace limen::scene
