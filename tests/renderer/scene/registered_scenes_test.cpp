// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "renderer/scene/light.h"
#include "renderer/scene/placement.h"
#include "tests/renderer/scene/geometry_checks.h"
#include "tests/renderer/scene/scene_fixtures.h"

namespace limen::scene {
namespace {

using fixtures::build;
using fixtures::EveryScene;
using fixtures::Given;

void expectSound(const Scene& scene) {
  // One assertion for all: there are millions of vertices.
  ASSERT_TRUE(std::all_of(scene.mesh.positions.begin(), scene.mesh.positions.end(), [](const glm::dvec3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
  }));
  ASSERT_TRUE(std::all_of(scene.mesh.triangles.begin(), scene.mesh.triangles.end(), [&](glm::uvec3 triangle) {
    return std::max({triangle.x, triangle.y, triangle.z}) < scene.mesh.positions.size();
  }));
  size_t next = 0;
  for (const Part& part : scene.parts) {
    EXPECT_EQ(part.firstTriangle, next) << part.name;
    EXPECT_LT(part.material, scene.materials.size()) << part.name;
    next += part.triangleCount;
  }
  EXPECT_EQ(next, scene.mesh.triangles.size());
  EXPECT_FALSE(scene.casterBounds().empty());
  // Rooms without a lamp are lit by what emits, or dark.
  ASSERT_TRUE(!scene.lights.empty() || scene.name.rfind("global_illumination/", 0) == 0) << scene.name;
  for (const AreaLight& light : scene.lights) {
    EXPECT_NO_THROW(checkLight(light, "test"));
    EXPECT_GT(light.area(), 0.0);
  }
  const Camera camera = scene.camera.at(0.0);
  EXPECT_GT(glm::length(camera.target - camera.eye), 0.0);
  EXPECT_TRUE(std::isfinite(glm::length(camera.eye)));
  for (const Material& material : scene.materials)
    for (int k = 0; k < 3; ++k) EXPECT_TRUE(material.albedo[k] >= 0.0F && material.albedo[k] <= 1.0F);
}

/// Both ends of a range, or every choice.
std::vector<ParameterValue> extremes(const Parameter& parameter) {
  switch (parameter.type) {
    case ParameterType::Boolean:
      return {false, true};
    case ParameterType::Integer:
      if (!parameter.allowed.empty()) return {parameter.allowed.front(), parameter.allowed.back()};
      return {static_cast<int64_t>(*parameter.minimum), static_cast<int64_t>(*parameter.maximum)};
    case ParameterType::Real:
      return {*parameter.minimum, *parameter.maximum};
    case ParameterType::Choice:
      return {parameter.choices.begin(), parameter.choices.end()};
    default:
      return {};
  }
}

TEST_P(EveryScene, BuildsWithDefaults) { expectSound(build(GetParam())); }

/// One test, so that each scene is made once: the largest take seconds.
TEST_P(EveryScene, IsSoundAtBothEndsOfEveryParameterAndChangedByItsOwn) {
  const SceneInfo& info = SceneRegistry::instance().get(GetParam());
  std::set<std::string> own;
  for (const DeclaredAt& at : flatten(info.parameters)) own.insert(at.path);
  const std::vector<Parameter> all = info.allParameters();
  // What every scene has places what its own parameters make.
  const Scene plain = build(GetParam());
  for (const DeclaredAt& at : flatten(all)) {
    // Other cameras need a text or a file: camera_parameters_test.cpp.
    if (at.path == "camera" || (at.when.contains("camera") && at.when.at("camera") != "built_in")) continue;
    // A picture needs a file: light_picture_test.cpp.
    if (at.when.contains("light_shape")) continue;
    std::set<std::string> hashes;
    for (const ParameterValue& value : extremes(*at.parameter)) {
      if (at.path == "light_shape" && value == ParameterValue(std::string("picture"))) continue;
      SCOPED_TRACE(at.path + " = " + toText(value));
      Given given(at.when.begin(), at.when.end());
      given[at.path] = value;
      if (own.contains(at.path)) {
        const Scene scene = build(GetParam(), given);
        expectSound(scene);
        hashes.insert(scene.contentHash());
      } else {
        Scene scene = plain;
        const SettingsTable<PlacementSettings>& placement = PlacementSettings::table();
        place(scene, placement.read(ParameterValues(placement.parameters(), given)), GetParam());
        expectSound(scene);
      }
    }
    // A file has no range.
    EXPECT_TRUE(hashes.empty() || hashes.size() >= 2) << at.path;
  }
}

TEST_P(EveryScene, IsTheSameTwice) {
  EXPECT_EQ(build(GetParam()).contentHash(), build(GetParam()).contentHash());
}

TEST_P(EveryScene, SaysWhatItIs) {
  const SceneInfo& info = SceneRegistry::instance().get(GetParam());
  EXPECT_FALSE(info.summary.empty());
  EXPECT_FALSE(info.source.empty());
  EXPECT_GE(info.version, 1);
  // A wall of controls helps nobody.
  EXPECT_LE(info.allParameters().size(), 16U);
  for (const DeclaredAt& at : flatten(info.parameters)) {
    const Parameter& parameter = *at.parameter;
    EXPECT_FALSE(parameter.description.empty()) << at.path;
    const bool number = parameter.type == ParameterType::Real || parameter.type == ParameterType::Integer;
    EXPECT_EQ(number, (parameter.minimum && parameter.maximum) || !parameter.allowed.empty()) << at.path;
    if (!parameter.required) {
      EXPECT_NO_THROW(validate(parameter, parameter.defaultValue, "test"));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, EveryScene, testing::ValuesIn(SceneRegistry::instance().names()),
                         fixtures::nameOf);

TEST(SphereGrid, HasTheSpheresAndTrianglesItSays) {
  const Scene scene = build("sphere_grid", {{"spheres_per_axis", int64_t{4}}, {"tessellation", int64_t{5}}});
  EXPECT_EQ(scene.parts[1].triangleCount, 4U * 4 * 4 * 8 * 5 * 5);
}

TEST(Boulders, HasAQuarterOfAMillionTrianglesByDefault) {
  const SceneInfo& info = SceneRegistry::instance().get("boulders");
  const Scene scene = buildScene("boulders", ParameterValues(info.allParameters(), Given{}));
  // 32 x 32 cells of ground and 24 lumps of 8 x 36 x 36 triangles.
  EXPECT_EQ(scene.mesh.triangles.size(), 2048U + 24U * 8U * 36U * 36U);
}

/// No lump reaches another's cell or the ground, so that none is inside another.
TEST(Boulders, KeepToTheirCells) {
  const Scene scene = build("boulders", {{"bumps", 0.8}, {"boulders", int64_t{6}}});
  const Part& part = scene.parts[1];
  const uint32_t each = part.triangleCount / 6;
  for (uint32_t i = 0; i < 6; ++i) {
    Bounds bounds;
    for (uint32_t t = 0; t < each; ++t)
      for (int k = 0; k < 3; ++k)
        bounds.extend(checks::corner(scene.mesh, part.firstTriangle + i * each + t, k));
    EXPECT_GT(bounds.low.y, 0.0);
    // Cells are half a unit wide.
    for (int axis = 0; axis < 3; ++axis) EXPECT_LT(bounds.high[axis] - bounds.low[axis], 0.5);
  }
}

/// Rays through the seam of the two halves must not see through it.
TEST(TexturedGround, HalvesShareTheVerticesOfTheirSeam) {
  const Scene scene = build("textured_ground", {{"textured_share", 0.3}});
  std::array<std::set<std::pair<double, double>>, 2> seam;
  const double border = 0.5 * 11.0 - 0.3 * 11.0;
  for (size_t part = 0; part < 2; ++part)
    for (uint32_t t = 0; t < scene.parts[part].triangleCount; ++t)
      for (int k = 0; k < 3; ++k) {
        const glm::dvec3 p = checks::corner(scene.mesh, scene.parts[part].firstTriangle + t, k);
        if (std::abs(p.x - border) < 1e-6) seam[part].insert({p.x, p.z});
      }
  EXPECT_EQ(seam[0].size(), 33U);
  EXPECT_EQ(seam[0], seam[1]);
}

/// The texture is a factor of the albedo alone: shadows with and without it are the same.
TEST(TexturedGround, TextureChangesNoGeometry) {
  const Scene with = build("textured_ground"),
              without = build("textured_ground", {{"texture", std::string("none")}});
  EXPECT_EQ(with.mesh.positions, without.mesh.positions);
  EXPECT_EQ(with.materials[1].pattern.kind, Pattern::Kind::ValueNoise);
  EXPECT_EQ(with.materials[0].pattern.kind, Pattern::Kind::None);
  EXPECT_EQ(without.materials[1].pattern.kind, Pattern::Kind::None);
}

TEST(DegenerateSoup, HasItsFlawsAboveASoundGround) {
  const Scene scene = build("degenerate_soup");
  size_t noArea = 0, repeatedIndex = 0, inLightPlane = 0, touching = 0;
  const double lightY = scene.lights[0].centre.y;
  for (const Part& part : scene.parts)
    for (size_t t = part.firstTriangle; t < part.firstTriangle + part.triangleCount; ++t) {
      const glm::dvec3 a = checks::corner(scene.mesh, t, 0), b = checks::corner(scene.mesh, t, 1),
                       c = checks::corner(scene.mesh, t, 2);
      // Twice the area, against the rounding of a triangle whose corners lie on a line.
      const bool flat = glm::length(glm::cross(b - a, c - a)) < 1e-15;
      if (part.receiverOnly) {
        ASSERT_FALSE(flat);
        continue;
      }
      const glm::uvec3 index = scene.mesh.triangles[t];
      noArea += flat;
      repeatedIndex += index.x == index.y || index.y == index.z || index.x == index.z;
      const int atLight = (a.y == lightY) + (b.y == lightY) + (c.y == lightY);
      inLightPlane += atLight == 3;
      touching += atLight == 1;
      EXPECT_LE(std::max({a.y, b.y, c.y}), lightY);
    }
  // Every tenth of 600 is of each kind; repeated vertices, lines and points have no area.
  EXPECT_EQ(repeatedIndex, 60U);
  EXPECT_EQ(noArea, 180U);
  EXPECT_EQ(inLightPlane, 60U);
  EXPECT_EQ(touching, 60U);
}

}  // namespace
}  // namespace limen::scene
