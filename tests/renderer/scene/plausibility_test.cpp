// SPDX-License-Identifier: BSD-3-Clause
// What a picture of each scene would show, by brute-force ray casting.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/renderer/scene/geometry_checks.h"
#include "tests/renderer/scene/scene_fixtures.h"

namespace limen::scene {
namespace {

using checks::intersect;
using fixtures::build;

class Plausible : public fixtures::EveryScene {};
class Solid : public testing::TestWithParam<std::string> {};

/// Parts that are closed surfaces, each made of closed pieces.
const std::map<std::string, std::set<std::string>> kClosedParts = {
    {"boulders", {"boulders"}},
    {"box_under_light", {"box"}},
    {"columns_hall", {"columns"}},
    {"comb", {"fence"}},
    {"cornell_box", {"short_block", "tall_block"}},
    {"foliage", {"wood"}},
    {"palm", {"wood", "creature"}},
    {"pole", {"pole"}},
    {"sphere_grid", {"spheres"}},
    {"street_light", {"pole", "wood"}},
    {"tessellated_corner", {"lumps"}},
    {"textured_ground", {"rails", "balls"}},
    {"textured_light", {"sphere", "cone"}},
    {"two_boxes", {"low_box", "high_box"}},
    {"two_colour_light", {"sphere", "cone"}},
    {"voxel_cases", {"frame", "block"}}};

/// Number of closed surfaces around a point: exits minus entries along a direction that meets no edge by
/// accident.
int windingNumber(const Mesh& mesh, const Part& part, glm::dvec3 point) {
  const glm::dvec3 direction(0.3219, 0.8713, -0.1737);
  Mesh one;
  one.positions = mesh.positions;
  int winding = 0;
  for (size_t t = part.firstTriangle; t < part.firstTriangle + part.triangleCount; ++t) {
    one.triangles = {mesh.triangles[t]};
    if (const auto hit = intersect(one, point, direction))
      winding += glm::dot(hit->normal, direction) > 0.0 ? 1 : -1;
  }
  return winding;
}

TEST_P(Solid, ClosedPartsAreManifoldAndOutward) {
  const Scene scene = build(GetParam());
  const std::set<std::string>& promised = kClosedParts.at(GetParam());
  size_t found = 0;
  for (const Part& part : scene.parts) {
    if (promised.count(part.name) == 0) continue;
    ++found;
    EXPECT_TRUE(checks::closedManifold(scene.mesh, part.firstTriangle, part.triangleCount)) << part.name;
    EXPECT_GT(checks::signedVolume(scene.mesh, part.firstTriangle, part.triangleCount), 0.0) << part.name;
  }
  EXPECT_EQ(found, promised.size());
}

TEST_P(Solid, CameraAndLightAreOutsideOfSolids) {
  const Scene scene = build(GetParam());
  const std::set<std::string>& promised = kClosedParts.at(GetParam());
  for (const Part& part : scene.parts) {
    if (promised.count(part.name) == 0) continue;
    EXPECT_EQ(windingNumber(scene.mesh, part, scene.camera.at(0.0).eye), 0);
    for (const glm::dvec2 unit : {glm::dvec2(0.5), glm::dvec2(0.0), glm::dvec2(1.0)})
      EXPECT_EQ(windingNumber(scene.mesh, part, scene.lights[0].point(unit)), 0);
  }
}

std::vector<std::string> scenesWithClosedParts() {
  std::vector<std::string> names;
  for (const auto& [name, parts] : kClosedParts) names.push_back(name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Scenes, Solid, testing::ValuesIn(scenesWithClosedParts()), fixtures::nameOf);

TEST_P(Plausible, LightIsAboveAndFacesTheScene) {
  const Scene scene = build(GetParam());
  const AreaLight& light = scene.lights[0];
  const glm::dvec3 casters = scene.casterBounds().centre();
  EXPECT_GT(light.centre.y, casters.y);
  EXPECT_LT(light.direction().y, 0.0);
  EXPECT_GT(glm::dot(light.direction(), casters - light.centre), 0.0);
  // All receivers in the lit half-space; the Cornell box alone has its ceiling behind the light.
  if (GetParam() == "cornell_box") return;
  const double rounding = 1e-12 * scene.bounds().diagonal();
  for (const glm::dvec3& p : scene.mesh.positions)
    ASSERT_GE(glm::dot(light.direction(), p - light.centre), -rounding);
}

TEST_P(Plausible, CameraSeesFrontFacesWithLightPenumbraAndShadow) {
  const Scene scene = build(GetParam());
  const Camera camera = scene.camera.at(0.0);
  const AreaLight& light = scene.lights[0];
  const double lift = 1e-6 * scene.bounds().diagonal();
  constexpr int kWidth = 20, kHeight = 15, kLight = 3;
  int hits = 0, lit = 0, mixed = 0, dark = 0;
  const auto centre = intersect(scene.mesh, camera.eye, glm::normalize(camera.target - camera.eye));
  EXPECT_TRUE(centre) << "the middle of the picture is empty";
  for (int j = 0; j < kHeight; ++j)
    for (int i = 0; i < kWidth; ++i) {
      const glm::dvec3 ray = checks::cameraRay(camera, 2.0 * (i + 0.5) / kWidth - 1.0,
                                               2.0 * (j + 0.5) / kHeight - 1.0, 4.0 / 3.0);
      const auto hit = intersect(scene.mesh, camera.eye, ray);
      if (!hit) continue;
      ++hits;
      const glm::dvec3 normal = glm::normalize(hit->normal);
      const glm::dvec3 facing = glm::dot(normal, ray) < 0.0 ? normal : -normal;
      const glm::dvec3 point = camera.eye + hit->distance * ray + lift * facing;
      int visible = 0;
      for (int s = 0; s < kLight * kLight; ++s) {
        const glm::dvec2 unit((s % kLight + 0.5) / kLight, (s / kLight + 0.5) / kLight);
        const glm::dvec3 to = light.point(unit) - point;
        visible += glm::dot(to, facing) > 0.0 && glm::dot(to, light.direction()) < 0.0 &&
                   !intersect(scene.mesh, point, to, 1e-9, 1.0 - 1e-9);
      }
      lit += visible == kLight * kLight;
      mixed += visible > 0 && visible < kLight * kLight;
      dark += visible == 0;
    }
  // A square room in a 4:3 picture leaves its sides empty, and so does a plane that is seen up to its edges.
  // Scenes of mirrors show the horizon, which mirrors show as well.
  const bool mirrors = GetParam().rfind("mirrors/", 0) == 0;
  const bool hasSides = mirrors || GetParam() == "cornell_box" || GetParam() == "resting_sphere";
  EXPECT_GE(hits, hasSides ? kWidth * kHeight * 6 / 10 : kWidth * kHeight);
  EXPECT_GE(lit, hits * 3 / 10);
  if (mirrors) return;  // they are not about penumbrae
  EXPECT_GE(mixed, hits / 100);
  EXPECT_GE(mixed + dark, hits / 50);
}

/// Scenes of levels of detail are about silhouettes before a background and rides, not about penumbrae; of a
/// sheet of patches nothing casts a shadow. Rooms of global illumination are closed, and some have no lamp. A
/// stream of items has no picture, and a mesh from a file is shown as it comes. Scenes that are voxelized
/// show where surfaces lie, an object alone, or parts that move before walls with nothing beside them.
std::vector<std::string> scenesOfShadows() {
  std::vector<std::string> names;
  for (const std::string& name : SceneRegistry::instance().names())
    if (name.rfind("lod/", 0) != 0 && name.rfind("global_illumination/", 0) != 0 && name != "curved/sheet" &&
        name != "stream" && name != "mirrors/mesh" && name != "voxel_cases" &&
        name.rfind("moving/", 0) != 0 && name != "tessellated_box")
      names.push_back(name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Scenes, Plausible, testing::ValuesIn(scenesOfShadows()), fixtures::nameOf);

TEST(ColumnsHall, WalkPassesThroughNoColumnAndStaysAboveTheFloor) {
  const Scene scene = build("columns_hall", {{"motion", std::string("walk")}});
  for (double t = 0.0; t <= scene.camera.durationS(); t += 0.1) {
    const Camera camera = scene.camera.at(t);
    EXPECT_EQ(windingNumber(scene.mesh, scene.parts[1], camera.eye), 0) << t;
    EXPECT_GT(camera.eye.y, 1.0) << t;
    EXPECT_TRUE(intersect(scene.mesh, camera.eye, camera.target - camera.eye)) << t;
  }
}

/// Share of a fine grid of light points that a ground point sees.
double visibleShare(const Scene& scene, glm::dvec3 ground, int columns, int rows) {
  int visible = 0;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const glm::dvec3 to = scene.lights[0].point({(i + 0.5) / columns, (j + 0.5) / rows}) - ground;
      visible += !intersect(scene.mesh, ground, to, 1e-9, 1.0 - 1e-9);
    }
  return visible / static_cast<double>(columns * rows);
}

Scene withoutGround(Scene scene) {
  std::vector<glm::uvec3>& triangles = scene.mesh.triangles;
  const Part& ground = scene.parts[0];
  EXPECT_TRUE(ground.receiverOnly);
  triangles.erase(triangles.begin(), triangles.begin() + ground.triangleCount);
  return scene;
}

TEST(HalfPlane, PenumbraIsLinearInDistanceFromTheEdge) {
  for (const double edge : {0.2, 1.0, 1.7}) {
    const Scene scene = withoutGround(build("half_plane", {{"edge_height", edge}}));
    const double height = 2.0, width = scene.lights[0].size.x;
    constexpr int kColumns = 256;
    for (const double z : {-4.0, 0.3, 4.0})
      for (double x = -4.0; x <= 4.0; x += 0.0625) {
        // The line from (x, 0) past the edge (0, edge) meets the light's plane at x (1 - height / edge).
        const double expected = std::clamp(0.5 + x * (height - edge) / (edge * width), 0.0, 1.0);
        EXPECT_NEAR(visibleShare(scene, {x, 0.0, z}, kColumns, 2), expected, 0.51 / kColumns)
            << x << " " << z;
      }
  }
}

TEST(ParallelRectangle, VisibilityIsTheUncoveredShareOfTheLight) {
  const Scene scene = withoutGround(build("parallel_rectangle"));
  const double light = 2.0, card = 0.7, factor = light / card;
  const glm::dvec2 half(0.3, 0.2), size = scene.lights[0].size;
  constexpr int kGrid = 64;
  for (double z = -0.5; z <= 0.5; z += 0.11)
    for (double x = -0.6; x <= 0.6; x += 0.11) {
      // The card seen from (x, 0, z) covers this rectangle of the light's plane.
      const glm::dvec2 p(x, z), low = p + (-half - p) * factor, high = p + (half - p) * factor;
      const glm::dvec2 overlap =
          glm::max(glm::min(high, 0.5 * size) - glm::max(low, -0.5 * size), glm::dvec2(0.0));
      const double expected = 1.0 - overlap.x * overlap.y / (size.x * size.y);
      EXPECT_NEAR(visibleShare(scene, {x, 0.0, z}, kGrid, kGrid), expected, 1.1 / kGrid) << x << " " << z;
    }
}

TEST(CardStack, ProjectiveCardsCoverEachOtherExactlyFromTheLightsCentre) {
  for (const int64_t cards : {2, 64}) {
    const Scene scene = build("card_stack", {{"cards", cards}});
    const glm::dvec3 centre = scene.lights[0].centre;
    const Part& part = scene.parts[1];
    ASSERT_EQ(part.triangleCount, 2U * cards);
    for (size_t t = part.firstTriangle + 2; t < part.firstTriangle + part.triangleCount; ++t)
      for (int k = 0; k < 3; ++k) {
        const glm::dvec3 first = checks::corner(scene.mesh, part.firstTriangle + t % 2, k) - centre;
        const glm::dvec3 other = checks::corner(scene.mesh, t, k) - centre;
        EXPECT_LT(other.y, first.y);
        EXPECT_NEAR(glm::length(other / other.y - first / first.y), 0.0, 1e-12);
      }
    EXPECT_GT(scene.casterBounds().low.y, 0.0);
  }
}

TEST(CardStack, UmbraCardsNeverChangeVisibilityOnTheGround) {
  const std::string umbra = "umbra";
  const Scene one = withoutGround(build("card_stack", {{"fit", umbra}, {"cards", int64_t{1}}}));
  const Scene many =
      withoutGround(build("card_stack", {{"fit", umbra}, {"cards", int64_t{64}}, {"spacing", 0.018}}));
  for (double z = -1.6; z <= 1.6; z += 0.171)
    for (double x = -1.6; x <= 1.6; x += 0.171)
      EXPECT_EQ(visibleShare(one, {x, 0.0, z}, 12, 12), visibleShare(many, {x, 0.0, z}, 12, 12))
          << x << " " << z;
}

TEST(BoxUnderLight, OnlyTheTopIsSeenFromTheLightsCentre) {
  const Scene scene = build("box_under_light");
  const AreaLight& light = scene.lights[0];
  EXPECT_GT(light.size.x, 1.0);
  bool sideSeenFromRim = false;
  for (double y = 0.05; y < 1.0; y += 0.1)
    for (double along = -0.45; along < 0.5; along += 0.1)
      for (const glm::dvec3 side : {glm::dvec3(0.5, y, along), glm::dvec3(-0.5, y, along),
                                    glm::dvec3(along, y, 0.5), glm::dvec3(along, y, -0.5)}) {
        const auto fromCentre = intersect(scene.mesh, light.centre, side - light.centre);
        ASSERT_TRUE(fromCentre);
        EXPECT_NEAR(light.centre.y + fromCentre->distance * (side.y - light.centre.y), 1.0, 1e-9);
        const glm::dvec3 rim = light.point({1.0, 0.5});
        const auto fromRim = intersect(scene.mesh, rim, side - rim);
        sideSeenFromRim = sideSeenFromRim || std::abs(fromRim->distance - 1.0) < 1e-9;
      }
  EXPECT_TRUE(sideSeenFromRim);
}

}  // namespace
}  // namespace limen::scene
