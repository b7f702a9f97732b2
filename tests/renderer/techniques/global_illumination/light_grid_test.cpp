// SPDX-License-Identifier: BSD-3-Clause
// What grids of light refuse, count and keep apart; closed forms of their limits.
#include <cmath>
#include <numbers>

#include "renderer/techniques/global_illumination/voxel_propagation/light_grid.h"
#include "tests/renderer/techniques/global_illumination/indirect_light_fixture.h"

namespace limen::techniques {
namespace {

class LightGridTest : public IndirectLightTest {};

/// GI-03. Of 131,072 triangles each puts in .4 units of the fixed-point sum at this radiance: the nearest
/// whole number of units is none. In the mean by chance the flux is pi e A, within the standard deviation of
/// so many roundings, .5 / sqrt(131072) / .4 = .35 %, three of them; the specification allows 2 %.
TEST_F(LightGridTest, DimLightOfFineMeshesIsNotLost) {
  const double emission = 0.001;
  scene::Scene scene;
  scene::Material glowing;
  glowing.name = "floor";
  glowing.albedo = glm::vec3(0.5F), glowing.emission = glm::vec3(static_cast<float>(emission));
  scene::addPart(scene, scene::planeGrid(glm::dvec3(0.0), 4.0, 4.0, 256), glowing);
  scene::addPart(scene, "post", scene::box({-0.2, 1.0, -0.2}, {0.2, 2.0, 0.2}), glm::vec3(0.0F));
  scene::setStillCamera(scene, {{0.0, 3.0, 6.0}, glm::dvec3(0.0), {0.0, 1.0, 0.0}, 45.0});
  double area = 0.0;
  for (uint32_t t = 0; t < scene.parts[0].triangleCount; ++t) {
    const glm::uvec3 corners = scene.mesh.triangles[t];
    const glm::dvec3 a = scene.mesh.positions[corners.x];
    area += 0.5 *
            glm::length(glm::cross(scene.mesh.positions[corners.y] - a, scene.mesh.positions[corners.z] - a));
  }
  const Rendered rendered =
      indirect(scene, {{"iterations", int64_t{0}}, {"format", std::string("32f")}}, true);
  const double expected = std::numbers::pi * emission * area;
  EXPECT_EQ(rendered.counter("homeless_samples"), 0.0);
  EXPECT_NEAR(rendered.counter("injected_flux"), expected, 0.011 * expected);
}

/// Grids share programs that differ in uniforms alone; frames of two, of cones of other angles, may take
/// turns.
TEST_F(LightGridTest, GridsOfOtherConesDoNotDisturbEachOther) {
  const scene::Scene scene = makeScene("global_illumination/room");
  const frame::GpuScene gpuScene(scene);
  frame::Frame frame(context(), scene, gpuScene, {8, 8});
  LightGridSettings narrow, wide;
  narrow.resolution = wide.resolution = 8, narrow.iterations = wide.iterations = 4;
  narrow.transport = ConeTransport{30.0, true}, wide.transport = ConeTransport{60.0, true};
  const auto fluxOf = [&](LightGrid& grid) {
    frame.begin();
    grid.update(frame);
    frame.end();
    return grid.flux().g;
  };
  LightGrid first(frame, narrow, {});
  const double alone = fluxOf(first);
  LightGrid second(frame, wide, {});
  EXPECT_NE(fluxOf(second), alone);
  EXPECT_EQ(fluxOf(first), alone);
}

/// Light that is put in before the first step of the first frame alone would be gone soon after.
TEST_F(LightGridTest, LightPutInOnceDoesNotGoOn) {
  for (const char* update : {"continued", "axis"}) {
    const Given given = {{"update", std::string(update)}, {"steps.sources", std::string("once")}};
    ASSERT_TRUE(refusal(kPropagation, given));
    EXPECT_NE(std::string(refusal(kPropagation, given)->what()).find("first frame"), std::string::npos);
    EXPECT_FALSE(refusal(kPropagation, {{"update", std::string(update)}}));
  }
  EXPECT_FALSE(refusal(kPropagation, {{"steps.sources", std::string("once")}}));
}

/// Each bounce with fields of its own takes all steps.
TEST_F(LightGridTest, CountsTheStepsOfAllBounces) {
  const scene::Scene scene = makeScene("global_illumination/room");
  const Given steps = {{"resolution", int64_t{8}}, {"iterations", int64_t{3}}};
  Given limited = steps;
  limited["steps.bounces"] = std::string("limited"), limited["steps.bounces.most"] = int64_t{3};
  EXPECT_EQ(indirect(scene, limited, true).counter("voxel_steps"),
            3.0 * indirect(scene, steps, true).counter("voxel_steps"));
}

/// GI-09. In a closed box that emits e and reflects a, paths of n bounces have e (a + a^2 + ... + a^n) at
/// every point, and no noise. Light of n bounces in voxels has the same, but that inner faces of the walls'
/// voxels, 14 a side, have an area of (14 / 14.1)^2 of the box's, 1.4 % less, for the same flux at each
/// bounce, and what is not yet absorbed after 128 steps. Shares of both are exact, so that the ratio of one
/// limit to the next is that of the sums within a per mille for each bounce, the rounding of halves.
TEST_F(LightGridTest, LimitedBouncesAreThoseOfPathsInAClosedBox) {
  const double emission = 0.5, albedo = 0.6;
  const scene::Scene box =
      makeScene("global_illumination/closed_box", {{"emission", emission}, {"albedo", albedo}});
  double sum = 0.0, term = emission, found = 0.0;
  for (int64_t most = 1; most <= 3; ++most) {
    term *= albedo;
    sum += term;
    const double before = found;
    found = meanOf(indirect(box, {{"steps.bounces", std::string("limited")},
                                  {"steps.bounces.most", most},
                                  {"iterations", int64_t{128}},
                                  {"format", std::string("32f")}})
                       .product,
                   0, 32);
    EXPECT_NEAR(found, sum, 0.015 * sum * double(most)) << most;
    if (most > 1) {
      EXPECT_NEAR(found - before, term, 0.015 * double(most) * term) << most;
    }
  }
}

/// GI-10. Each bounce off a red and a green wall is of their colours; with .5 everywhere the second is not,
/// so that differences of the channels are farther from those of paths.
TEST_F(LightGridTest, StoredAlbedoBleedsColourAsPathsDo) {
  const scene::Scene box = makeScene("cornell_box");
  const auto colours = [](const Image& picture) {
    Image out(picture.width, picture.height, 4);
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x)
        for (int c = 0; c < 3; ++c) out.at(x, y, c) = picture.at(x, y, c) - picture.at(x, y, (c + 1) % 3);
    return out;
  };
  const Image reference = truth(box), nothing(32, 24, 4);
  const auto apart = [&](const char* albedo) {
    return error(colours(indirect(box, {{"albedo", std::string(albedo)}}).product), colours(reference));
  };
  const double stored = apart("stored"), half = apart("half");
  EXPECT_LT(stored, 0.6 * error(nothing, colours(reference)));
  EXPECT_LT(stored, half);
}

/// GI-11. Columns hide their feet from all voxels around, which are black then; light of the nearest voxel
/// that they see takes some of that away.
TEST_F(LightGridTest, CrevicesAreLitByWhatTheySee) {
  const scene::Scene scene = makeScene("columns_hall");
  const Image reference = truth(scene);
  const auto of = [&](int64_t widest) {
    return error(indirect(scene, {{"reconstruction.weights.widest", widest}}).product, reference);
  };
  const double without = of(1);
  EXPECT_LT(of(2), 0.97 * without);
  EXPECT_EQ(error(indirect(scene, {}).product, reference), of(2));
}

}  // namespace
}  // namespace limen::techniques
