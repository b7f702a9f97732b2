// SPDX-License-Identifier: BSD-3-Clause
#include <bit>
#include <random>

#include "renderer/many_lods/multi_cut.h"
#include "renderer/many_lods/node_predicate.h"
#include "renderer/many_lods/view_atlas.h"
#include "renderer/techniques/many_lods/many_lods_pass_bindings.h"
#include "renderer/techniques/many_lods/polygon_tiles.h"
#include "renderer/techniques/many_lods/scene_tree.h"
#include "renderer/techniques/many_lods/virtual_lights.h"
#include "tests/renderer/techniques/many_lods/double_rays.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

class RadiosityPictures : public TechniqueTest {
 protected:
  static double mean(const Image& picture) {
    double sum = 0.0;
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x)
        for (int c = 0; c < 3; ++c) sum += double(picture.at(x, y, c));
    return sum / (3.0 * picture.width * picture.height);
  }
};

// The same light by paths in double precision, with directions of its own: from the light's centre with the
// cosine's density to a surface, and from there to the point that a pixel sees. The mean over the picture of
// 12 x 12 pixels and 400 paths has a standard error of less than 2 %, as have 1,024 lights of the pattern.
TEST_F(RadiosityPictures, TracedLightIsThatOfPaths) {
  const scene::Scene scene = makeScene("cornell_box");
  constexpr int kSide = 12, kPaths = 400;
  const Image found = render(scene, "many_lods/traced_radiosity",
                             {{"lights", int64_t{1024}}, {"clamp", 0.1}, {"gain", 1.0}}, {kSide, kSide})
                          .product;
  const scene::AreaLight& light = scene.lights[0];
  const double flux = std::acos(-1.0) * light.area() * double(light.parts[0].radiance.x);
  const double least2 = std::pow(0.1 * scene.bounds().diagonal(), 2.0);
  std::mt19937 random(17);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<Met> lights;
  for (int i = 0; i < kPaths; ++i) {
    const double radius = std::sqrt(unit(random)), turn = 2.0 * std::acos(-1.0) * unit(random);
    const glm::dvec3 direction = light.axisX * (radius * std::cos(turn)) +
                                 light.axisY * (radius * std::sin(turn)) +
                                 light.direction() * std::sqrt(1.0 - radius * radius);
    const Met at = firstMet(scene, light.centre, direction, 0.0, INFINITY);
    if (std::isfinite(at.along)) lights.push_back(at);
  }
  double sum = 0.0;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const glm::dvec3 direction = pixelDirection(scene, x, y, kSide, kSide);
      const Met seen = firstMet(scene, scene.camera.at(0.0).eye, direction, 0.0, INFINITY);
      if (!std::isfinite(seen.along)) continue;
      for (const Met& from : lights) {
        const glm::dvec3 path = from.position - seen.position;
        const double distance2 = glm::dot(path, path);
        const double cosines = glm::dot(path, seen.normal) * -glm::dot(path, from.normal) / distance2;
        if (glm::dot(path, seen.normal) <= 0.0 || cosines <= 0.0) continue;
        if (std::isfinite(firstMet(scene, seen.position, path, 1e-6, 1.0 - 1e-6).along)) continue;
        const double share = cosines / (std::acos(-1.0) * std::acos(-1.0) * std::max(distance2, least2));
        for (int c = 0; c < 3; ++c) sum += flux / kPaths * share * from.albedo[c] * seen.albedo[c];
      }
    }
  const double expected = sum / (3.0 * kSide * kSide);
  ASSERT_GT(expected, 0.0);
  EXPECT_NEAR(mean(found), expected, 0.08 * expected);
}

// Energy: virtual lights carry what rays gather from lit surfaces, with the same bound on the light of near
// surfaces (without one, single lights near a receiver would outweigh all others). 4,096 lights and 512 rays
// a pixel, of low discrepancy: half a percent each. In the hall and on the sphere about a hundred of the
// lights lie where what is seen looks: a few percent.
TEST_F(RadiosityPictures, VirtualLightsCarryTheLightThatRaysGather) {
  for (const char* name : {"cornell_box", "columns_hall", "resting_sphere"}) {
    const scene::Scene scene = makeScene(name);
    const auto gathered = [&](double clamp) {
      return mean(
          render(scene, "many_lods/ray_gathered", {{"rays", int64_t{512}}, {"light.clamp", clamp}}, {16, 16})
              .product);
    };
    const double light = gathered(0.1), all = gathered(0.0);
    ASSERT_GT(light, 0.0) << name;
    // A bound takes light away.
    EXPECT_LT(light, all) << name;
    const auto with = [&](const char* technique, int64_t count) {
      return mean(render(scene, technique, {{"lights", count}, {"clamp", 0.1}}, {16, 16}).product);
    };
    const double tolerance = std::string(name) == "cornell_box" ? 0.01 : 0.05;
    EXPECT_NEAR(with("many_lods/traced_radiosity", 4096), light, tolerance * light) << name;
    // Shadow maps of 64 pixels: outlines shift, and light leaks at contacts, by less than a pixel.
    EXPECT_NEAR(with("many_lods/polygon_shadow_maps", 2048), light, (tolerance + 0.02) * light) << name;
  }
}

// All triangles in maps of 64 pixels against rays for the same lights: shadows' outlines are off by half a
// pixel and the bias by one, of 20 or so across a shadow. Twice the pixels, half the error, a quarter more.
TEST_F(RadiosityPictures, ShadowMapsOfPolygonsComeToRays) {
  const scene::Scene scene = makeScene("cornell_box");
  const Given lights = {{"lights", int64_t{32}}};
  const Image truth = render(scene, "many_lods/traced_radiosity", lights, {40, 40}).product;
  double before = 0.12 * mean(truth);
  for (const int64_t tile : {32, 64, 128}) {
    Given given = lights;
    given["tile"] = tile;
    const double error =
        meanDifference(render(scene, "many_lods/polygon_shadow_maps", given, {40, 40}).product, truth);
    EXPECT_LT(error, 0.67 * before) << tile;
    before = error;
  }
}

// Tiles against rays in double precision through their pixels' middles. Triangles: the same depth up to
// floats. Discs of 16,384 points: within a disc's radius, but for pixels at outlines.
TEST_F(RadiosityPictures, TilesHoldTheDepthsThatRaysMeet) {
  const scene::Scene scene = makeScene("cornell_box");
  const frame::GpuScene gpuScene(scene);
  frame::Frame frame(context(), scene, gpuScene, {8, 8});
  constexpr int kSide = 32;
  const glm::dvec3 anchor = gpuScene.anchor();
  const double range = 1.01 * gpuScene.diagonal();
  const std::vector<many_lods::CutView> views = {
      many_lods::hemisphereView(glm::dvec3(0.2, 0.01, 0.3) - anchor, {0.0, 1.0, 0.0}, kSide, 1.0, range),
      many_lods::hemisphereView(glm::dvec3(0.54, 0.3, 0.2) - anchor, {-1.0, 0.0, 0.0}, kSide, 1.0, range),
      many_lods::perspectiveView(glm::dvec3(0.3, 0.3, -0.6) - anchor, {0.1, -0.1, 1.0}, {0.0, -1.0, 0.0},
                                 {0.4, 0.4}, kSide, 1.0, 3.0 * range)};
  const gl::Buffer viewBuffer(views);
  const many_lods::ViewAtlas triangles(context(), 3, glm::ivec2(kSide), many_lods::AtlasForm::Depth),
      discs(context(), 3, glm::ivec2(kSide), many_lods::AtlasForm::Depth, many_lods::Discs::Oriented);
  const SceneTree tree(frame, {.levels = 14});
  many_lods::MultiCut cut(context(), 3, 14, 3 * 16384, many_lods::BasicCuts{});
  const PolygonTiles polygons(frame);
  frame.begin();
  polygons.draw(frame, viewBuffer, 3, triangles);
  cut.update(tree.tree().nodes(), viewBuffer, false);
  discs.draw(cut, tree.tree().nodes(), viewBuffer, tree.discs(0.0));
  frame.end();
  const std::vector<uint32_t> exact = triangles.depths().read<uint32_t>(),
                              near = discs.depths().read<uint32_t>();
  int seen = 0, wrong = 0, far = 0;
  for (size_t number = 0; number < views.size(); ++number)
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        const many_lods::CutView& view = views[number];
        const glm::dvec2 at = 2.0 * (glm::dvec2(x, y) + 0.5) / double(kSide) - 1.0;
        const double square = glm::dot(at, at);
        const bool hemisphere = number < 2;
        if (hemisphere && square >= 1.0) continue;
        const glm::dvec3 local = hemisphere ? glm::dvec3(2.0 * at, 1.0 - square) / (1.0 + square)
                                            : glm::dvec3(at * glm::dvec2(view.axisX.w, view.axisY.w), 1.0);
        const glm::dvec3 direction = local.x * glm::dvec3(glm::vec3(view.axisX)) +
                                     local.y * glm::dvec3(glm::vec3(view.axisY)) +
                                     local.z * glm::dvec3(glm::vec3(view.axisZ));
        const double expected =
            firstMet(scene, glm::dvec3(glm::vec3(view.eye)) + anchor, direction, 0.0, INFINITY).along *
            double(view.frustum.z);
        const size_t index = (number * kSide + size_t(y)) * kSide + size_t(x);
        const auto held = [&](const std::vector<uint32_t>& depths) {
          return depths[index] == many_lods::kAtlasEmpty ? double(INFINITY)
                                                         : double(std::bit_cast<float>(depths[index]));
        };
        const auto apart = [&](double value) {
          return std::isfinite(expected) != std::isfinite(value) ||
                 (std::isfinite(expected) && std::abs(value - expected) > 1e-5);
        };
        ++seen;
        wrong += apart(held(exact)) ? 1 : 0;
        const double off = std::abs(held(near) - expected);
        far += std::isfinite(expected) && !(off < tree.tree().leafRadius() * double(view.frustum.z)) ? 1 : 0;
      }
  ASSERT_GT(seen, 2000);
  // Rays that run along an edge.
  EXPECT_LE(wrong, seen / 500);
  // Outlines of two blocks and five walls: a tenth of the pixels.
  EXPECT_LE(far, seen / 10);
}

// Shadow maps of 64 pixels against rays for the same lights: their discs are a pixel or two in size, so that
// outlines of shadows shift by that, 3 degrees. 10 % of the mean light is allowed.
TEST_F(RadiosityPictures, ShadowMapsFromCutsComeNearToRays) {
  const scene::Scene scene = makeScene("cornell_box");
  const Given lights = {{"lights", int64_t{32}}};
  const Image truth = render(scene, "many_lods/traced_radiosity", lights, {40, 40}).product;
  for (const char* cuts : {"incremental", "in_place"}) {
    Given given = lights;
    given["levels"] = int64_t{14};
    given["cuts"] = std::string(cuts);
    // One, for a software renderer's limit on loops.
    if (std::string(cuts) == "in_place") given["cuts.views_per_group"] = int64_t{1};
    const Rendered found = render(scene, "many_lods/instant_radiosity", given, {40, 40}, true);
    EXPECT_EQ(found.counter("refused_splits"), 0.0) << cuts;
    if (std::string(cuts) == "in_place") {
      ASSERT_EQ(found.counter("unfinished_groups"), 0.0);
      EXPECT_LE(found.counter("stack_entries"), found.counter("stack_bound"));
    }
    EXPECT_LT(meanDifference(found.product, truth), 0.1 * mean(truth)) << cuts;
  }
}

// In place or from lists, cuts are the same from the root.
TEST_F(RadiosityPictures, InPlaceOrOneByOneIsTheSamePicture) {
  const scene::Scene scene = makeScene("columns_hall");
  // Few and small, for a software renderer's limit on loops.
  const Given given = {{"lights", int64_t{10}}, {"levels", int64_t{9}}, {"tile", int64_t{8}}};
  Given inPlace = given;
  inPlace["cuts"] = std::string("in_place");
  inPlace["cuts.views_per_group"] = int64_t{3};
  Given sequential = given;
  sequential["cuts"] = std::string("sequential");
  const Image listed = render(scene, "many_lods/instant_radiosity", given, {24, 24}).product;
  EXPECT_EQ(render(scene, "many_lods/instant_radiosity", inPlace, {24, 24}).product.data, listed.data);
  EXPECT_EQ(render(scene, "many_lods/instant_radiosity", sequential, {24, 24}).product.data, listed.data);
}

// As the light turns by half a degree, lights move by that angle and what the surface's slope makes of it: by
// less than a twentieth of the scene unless their ray meets another surface, and randomly chosen ones would
// be a third of it apart.
TEST_F(RadiosityPictures, LightsStayThemselvesAsTheLightMoves) {
  const scene::Scene scene = makeScene("columns_hall");
  const frame::GpuScene gpuScene(scene);
  frame::Frame frame(context(), scene, gpuScene, {8, 8});
  const VirtualLights lights(frame, {.count = 512, .turnDeg = 0.5});
  frame.begin();
  lights.make(frame, 0, 64, 1.0, 0.0);
  const std::vector<VirtualLight> before = lights.lights().read<VirtualLight>();
  lights.make(frame, 0, 64, 1.0, 0.0);
  const std::vector<VirtualLight> same = lights.lights().read<VirtualLight>();
  lights.make(frame, 1, 64, 1.0, 0.0);
  const std::vector<VirtualLight> after = lights.lights().read<VirtualLight>();
  frame.end();
  int there = 0, near = 0;
  double moved = 0.0;
  for (size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(before[i].position, same[i].position);
    if (before[i].position.w == 0.0F || after[i].position.w == 0.0F) continue;
    ++there;
    const double distance = glm::distance(glm::vec3(before[i].position), glm::vec3(after[i].position));
    near += distance < 0.05 * scene.bounds().diagonal() ? 1 : 0;
    moved += distance;
  }
  ASSERT_GT(there, 20);
  EXPECT_GT(near, 0.9 * there);
  EXPECT_GT(moved, 0.0);
}

}  // namespace
}  // namespace limen::techniques
