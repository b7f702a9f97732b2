// SPDX-License-Identifier: BSD-3-Clause
// Paths over diffuse surfaces: the tracers on GPU and CPU against cases with closed forms, and against each
// other within the standard errors that they count.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

constexpr const char* kTraced = "global_illumination/path_traced";
constexpr const char* kReference = "global_illumination/path_reference";

class LightPaths : public TechniqueTest {
 protected:
  static Given paths(int64_t count, int64_t bounces, const std::string& light) {
    return {{"paths", count}, {"bounces", bounces}, {"light", light}};
  }
};

class EachTracer : public LightPaths, public testing::WithParamInterface<const char*> {};

double meanOf(const Image& image) {
  double sum = 0.0;
  for (size_t i = 0; i < image.pixels(); ++i)
    for (size_t c = 0; c < 3; ++c) sum += image.data[4 * i + c] / 3.0;
  return sum / double(image.pixels());
}

double largestOf(const Image& image) {
  double largest = 0.0;
  for (size_t i = 0; i < image.pixels(); ++i)
    for (size_t c = 0; c < 3; ++c) largest = std::max(largest, std::abs(double(image.data[4 * i + c])));
  return largest;
}

// In an enclosure of any shape whose surfaces all emit Le and reflect a, every path brings Le a^k at its k-th
// reflection: no noise. A path lost between walls would be missed in its pixel.
TEST_P(EachTracer, AGlowingEnclosureHasTheGeometricSum) {
  constexpr double kEmitted = 0.5, kAlbedo = 0.6;
  for (const double opening : {1.0, 0.3}) {
    const scene::Scene room = makeScene("global_illumination/two_rooms", {{"opening", opening},
                                                                          {"albedo", kAlbedo},
                                                                          {"glow", kEmitted},
                                                                          {"lamp", false},
                                                                          {"coloured", false}});
    double sum = 0.0;
    for (const int64_t bounces : {0, 1, 2, 5}) {
      sum = kEmitted * (1.0 - std::pow(kAlbedo, double(bounces + 1))) / (1.0 - kAlbedo);
      const Rendered rendered = render(room, GetParam(), paths(8, bounces, "all"), {48, 36});
      // Fewer than 32 roundings of 2^-24 each, of albedo, share, sum and mean.
      for (size_t i = 0; i < rendered.product.pixels(); ++i)
        ASSERT_NEAR(rendered.product.data[4 * i], sum, 32.0 * 0x1p-24 * sum) << "pixel " << i;
    }
  }
}

// In a sphere all points see each other alike, so that what is reflected once lights all of it evenly. The
// cosine towards a lamp at d from the centre is 1 - d^2 / 3 R^2 in the mean over the sphere.
TEST_P(EachTracer, ASphereIsLitEvenlyByEachReflection) {
  constexpr double kRadius = 2.0, kAway = 1.0, kAlbedo = 0.7, kStrength = 0.8;
  constexpr int kCells = 24;
  scene::Scene scene;
  addPart(scene, "sphere", scene::sphere(glm::dvec3(0.0), kRadius, kCells),
          glm::vec3(static_cast<float>(kAlbedo)));
  scene.lights = {scene::lightTowards({0.0, kAway, 0.0}, {0.0, -1.0, 0.0}, glm::dvec2(0.1))};
  setStillCamera(scene, {{0.0, 0.0, 1.0}, {0.3, 0.2, -1.0}, {0.0, 1.0, 0.0}, 70.0});
  const double first = kStrength * kAlbedo * (1.0 - kAway * kAway / (3.0 * kRadius * kRadius));
  double expected = 0.0, term = first;
  for (int bounces = 1; bounces <= 4; ++bounces) {
    term *= kAlbedo;
    expected += term;
    if (bounces == 3) continue;
    const Rendered rendered = render(scene, GetParam(), paths(64, bounces, "indirect"), {24, 24}, true);
    // Triangles turn from the sphere by up to 0.07: half the square of it, in each reflection's flux.
    const double noise = rendered.counter("standard_error") / 24.0;
    EXPECT_LT(noise, 0.003 * expected);
    EXPECT_NEAR(meanOf(rendered.product), expected, 4.0 * noise + 0.0025 * expected) << bounces;
  }
}

// Irradiance at distance h below the middle of a disc of radius R: pi Le R^2 / (R^2 + h^2).
TEST_P(EachTracer, ADiscLightsAPlateByItsFormFactor) {
  constexpr double kRadius = 1.0, kHeight = 1.2, kAlbedo = 0.5, kEmitted = 2.0;
  constexpr uint32_t kSegments = 256;
  for (const bool facesPlate : {true, false}) {
    scene::Scene scene;
    addPart(scene, "plate", scene::card(glm::dvec3(0.0), {0.2, 0.0, 0.0}, {0.0, 0.0, -0.2}),
            glm::vec3(static_cast<float>(kAlbedo)));
    scene::Mesh disc;
    disc.positions.push_back({0.0, kHeight, 0.0});
    for (uint32_t i = 0; i < kSegments; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kSegments;
      disc.positions.push_back({kRadius * std::cos(angle), kHeight, kRadius * std::sin(angle)});
      const uint32_t at = i + 1, next = (i + 1) % kSegments + 1;
      // x to z is clockwise from above: this order looks down.
      disc.triangles.push_back(facesPlate ? glm::uvec3(0, at, next) : glm::uvec3(0, next, at));
    }
    scene::Material lamp;
    lamp.name = "disc";
    lamp.albedo = glm::vec3(0.0F);
    lamp.emission = glm::vec3(static_cast<float>(kEmitted));
    addPart(scene, disc, lamp);
    setStillCamera(scene, {{0.0, 0.5, 3.0}, glm::dvec3(0.0), {0.0, 1.0, 0.0}, 0.2});
    const Rendered rendered = render(scene, GetParam(), paths(256, 1, "all"), {16, 16}, true);
    const double expected =
        facesPlate ? kAlbedo * kEmitted * kRadius * kRadius / (kRadius * kRadius + kHeight * kHeight) : 0.0;
    // 256 pixels. The polygon's area is 1e-4 less than the disc's; pixels are up to 0.03 from the middle,
    // which changes the form factor by its square.
    const double noise = rendered.counter("standard_error") / 16.0;
    EXPECT_LT(noise, 0.006);
    EXPECT_NEAR(meanOf(rendered.product), expected, 4.0 * noise + 1e-3 * expected);
  }
}

TEST_P(EachTracer, AClosedWallLetsNothingThrough) {
  for (const double thickness : {0.1, 0.0}) {
    const scene::Scene room = makeScene("global_illumination/two_rooms",
                                        {{"opening", 0.0}, {"thickness", thickness}, {"emitter", 10.0}});
    EXPECT_EQ(largestOf(render(room, GetParam(), paths(16, 4, "all"), {48, 36}).product), 0.0);
  }
  const scene::Scene open = makeScene("global_illumination/two_rooms", {{"opening", 0.4}, {"emitter", 10.0}});
  EXPECT_GT(meanOf(render(open, GetParam(), paths(16, 2, "all"), {48, 36}).product), 0.01);
}

TEST_P(EachTracer, PartsAddUp) {
  const scene::Scene room = makeScene("global_illumination/two_rooms", {{"emitter", 1.0}});
  const Image direct = render(room, GetParam(), paths(4, 2, "direct"), {32, 24}).product;
  const Image indirect = render(room, GetParam(), paths(4, 2, "indirect"), {32, 24}).product;
  const Image all = render(room, GetParam(), paths(4, 2, "all"), {32, 24}).product;
  EXPECT_GT(largestOf(indirect), 0.0);
  for (size_t i = 0; i < all.data.size(); ++i)
    if (i % 4 != 3) {
      // One rounding of each sum of five.
      ASSERT_NEAR(all.data[i], direct.data[i] + indirect.data[i], 8.0 * 0x1p-24 * all.data[i]);
    }
}

INSTANTIATE_TEST_SUITE_P(Both, EachTracer, testing::Values(kTraced, kReference),
                         [](const auto& tracer) { return std::string(tracer.param).substr(20); });

// Two estimates of one integral differ by as much as their standard errors say: more is a fault of one, less
// of the errors.
TEST_F(LightPaths, TracersAgreeWithinTheirStandardErrors) {
  struct Case {
    const char* name;
    Given given;
    double noise;  ///< of the picture's mean, share of it: what bias this test would see
  };
  const Case cases[] = {
      {"cornell_box", {}, 0.01},
      {"mirrors/room", {}, 0.01},
      {"global_illumination/two_rooms", {{"opening", 0.4}}, 0.01},
      {"global_illumination/two_rooms", {{"opening", 1.0}, {"emitter", 5.0}, {"lamp", false}}, 0.04}};
  constexpr glm::ivec2 kSize{64, 48};
  const double pixels = kSize.x * kSize.y;
  for (const Case& given : cases) {
    const scene::Scene scene = makeScene(given.name, given.given);
    const Rendered gpu = render(scene, kTraced, paths(32, 2, "indirect"), kSize, true);
    const Rendered cpu = render(scene, kReference, paths(32, 2, "indirect"), kSize, true);
    const double variance =
        std::pow(gpu.counter("standard_error"), 2.0) + std::pow(cpu.counter("standard_error"), 2.0);
    double squares = 0.0;
    for (size_t i = 0; i < gpu.product.pixels(); ++i) {
      double difference = 0.0;
      for (size_t c = 0; c < 3; ++c)
        difference += (double(gpu.product.data[4 * i + c]) - cpu.product.data[4 * i + c]) / 3.0;
      squares += difference * difference / pixels;
    }
    SCOPED_TRACE(given.name);
    // 0.026 is the deviation of 3,072 squares of normal numbers; pixels differ in noise and have long tails.
    EXPECT_NEAR(squares / variance, 1.0, 0.2);
    EXPECT_LT(std::abs(meanOf(gpu.product) - meanOf(cpu.product)), 4.0 * std::sqrt(variance / pixels));
    EXPECT_LT(std::sqrt(variance / pixels), given.noise * meanOf(cpu.product));
  }
}

}  // namespace
}  // namespace limen::techniques
