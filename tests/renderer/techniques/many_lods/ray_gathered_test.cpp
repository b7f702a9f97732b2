// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <numbers>
#include <random>

#include "renderer/techniques/many_lods/sky.h"
#include "tests/renderer/techniques/many_lods/double_rays.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

class GatheredRays : public TechniqueTest {
 protected:
  static double mean(const Image& picture) {
    double sum = 0.0;
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x)
        for (int c = 0; c < 3; ++c) sum += double(picture.at(x, y, c));
    return sum / (3.0 * picture.width * picture.height);
  }
  /// The ground alone.
  static scene::Scene openFloor() {
    scene::Scene scene = makeScene("half_plane");
    const auto ground = std::find_if(scene.parts.begin(), scene.parts.end(),
                                     [](const auto& part) { return part.receiverOnly; });
    const scene::Part kept = *ground;
    scene.mesh.triangles = {scene.mesh.triangles.begin() + kept.firstTriangle,
                            scene.mesh.triangles.begin() + kept.firstTriangle + kept.triangleCount};
    scene.parts = {kept};
    scene.parts[0].firstTriangle = 0;
    return scene;
  }
};

// In double precision, with random directions by the cosine: 400 a pixel. Four times the standard error of
// their mean is allowed, and half a percent for the other side's pattern.
TEST_F(GatheredRays, TheLampsLightIsThatOfDoublePrecision) {
  const scene::Scene scene = makeScene("cornell_box");
  constexpr int kSide = 8, kRays = 400;
  const Image found =
      render(scene, "many_lods/ray_gathered", {{"rays", int64_t{1024}}, {"light.gain", 1.0}}, {kSide, kSide})
          .product;
  const scene::AreaLight& light = scene.lights[0];
  const double intensity = light.area() * double(light.parts[0].radiance.x);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  double sum = 0.0, squares = 0.0;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const Met seen =
          firstMet(scene, scene.camera.at(0.0).eye, pixelDirection(scene, x, y, kSide, kSide), 0.0, INFINITY);
      if (!std::isfinite(seen.along)) continue;
      for (int ray = 0; ray < kRays; ++ray) {
        // A point of the unit sphere about the normal's end: by the cosine.
        glm::dvec3 point(0.0);
        do point = 2.0 * glm::dvec3(unit(random), unit(random), unit(random)) - 1.0;
        while (glm::dot(point, point) > 1.0 || glm::dot(point, point) < 1e-9);
        const glm::dvec3 direction = glm::normalize(seen.normal + glm::normalize(point));
        const Met from = firstMet(scene, seen.position, direction, 1e-7, INFINITY);
        if (!std::isfinite(from.along)) continue;
        const glm::dvec3 path = light.centre - from.position;
        const double distance = glm::length(path), received = glm::dot(path, from.normal) / distance,
                     sent = -glm::dot(path, light.direction()) / distance;
        if (!(received > 0.0 && sent > 0.0) ||
            std::isfinite(firstMet(scene, from.position, path, 1e-6, 1.0 - 1e-6).along))
          continue;
        const double lit = intensity * received * sent / (std::numbers::pi * distance * distance);
        const glm::dvec3 colour = seen.albedo * from.albedo * lit;
        const double value = (colour.r + colour.g + colour.b) / 3.0;
        sum += value;
        squares += value * value;
      }
    }
  constexpr double kAll = double(kRays) * kSide * kSide;
  const double expected = sum / kAll, error = std::sqrt((squares / kAll - expected * expected) / kAll);
  ASSERT_GT(expected, 0.0);
  ASSERT_LT(error, 0.03 * expected);
  EXPECT_NEAR(mean(found), expected, 4.0 * error + 0.005 * expected);
}

// Over an open floor the integral is closed: with s = height, the sky adds pi H + 2 pi / 3 (Z - H), a sun of
// width w in the zenith 2 pi (w^2 - w^4 (1 - exp(-1 / w^2))). 8 bits of albedo: a third of a percent. However
// light reaches the floor, no point, triangle or ray may hide any of it.
TEST_F(GatheredRays, ASkyOverAnOpenFloorIsItsIntegral) {
  const scene::Scene scene = openFloor();
  const double albedo = double(scene.materials[scene.parts[0].material].albedo.r);
  const double w = glm::radians(20.0), w2 = w * w;
  const double irradiance = std::numbers::pi * 1.0 + 2.0 * std::numbers::pi / 3.0 * (0.5 - 1.0) +
                            4.0 * 2.0 * std::numbers::pi * (w2 - w2 * w2 * (1.0 - std::exp(-1.0 / w2)));
  const double expected = albedo * irradiance / std::numbers::pi;
  const Given sky = {
      {"zenith", 0.5}, {"horizon", 1.0}, {"sun", 4.0}, {"sun_width", 20.0}, {"sun_elevation", 90.0}};
  const auto seen = [&](const Rendered& rendered) {
    double sum = 0.0;
    int count = 0;
    for (int y = 0; y < rendered.product.height; ++y)
      for (int x = 0; x < rendered.product.width; ++x)
        if (rendered.product.at(x, y) > 0.0F) sum += double(rendered.product.at(x, y)), ++count;
    EXPECT_GT(count, 20);
    return sum / count;
  };
  Given rays = {{"rays", int64_t{512}}, {"light", std::string("sky")}};
  for (const auto& [name, value] : sky) rays["light." + name] = value;
  EXPECT_NEAR(seen(render(scene, "many_lods/ray_gathered", rays, {16, 12})), expected, 0.01 * expected);
  for (const char* shadows : {"rays", "polygons", "cuts"}) {
    Given lights = {{"lights", int64_t{512}}, {"shadows", std::string(shadows)}};
    for (const auto& [name, value] : sky) lights["sky." + name] = value;
    if (std::string(shadows) == "cuts")
      lights["shadows.levels"] = int64_t{12}, lights["shadows.room"] = int64_t{4096};
    EXPECT_NEAR(seen(render(scene, "many_lods/natural_illumination", lights, {16, 12})), expected,
                0.01 * expected)
        << shadows;
  }
}

// The lights' sum is the sky's light from all around, 2 pi (H + (Z - H) / 2 + G) and a sun's
// 2 pi w^2 (1 - exp(-2 / w^2)), wherever the sun stands: R2 of 1,024 points, half a percent.
TEST_F(GatheredRays, LightsOfASkyCarryItsWholeLight) {
  for (const double elevation : {-30.0, 0.0, 60.0}) {
    const SkySettings sky{.zenith = 0.3,
                          .horizon = 0.9,
                          .ground = 0.2,
                          .sun = 10.0,
                          .sunWidthDeg = 8.0,
                          .sunElevationDeg = elevation};
    const double w = glm::radians(8.0);
    const double expected = 2.0 * std::numbers::pi *
                            (0.9 + 0.5 * (0.3 - 0.9) + 0.2 + 10.0 * w * w * (1.0 - std::exp(-2.0 / (w * w))));
    double sum = 0.0;
    for (const SkyLight& light : skyLights(sky, 1024)) {
      sum += light.irradiance;
      ASSERT_NEAR(glm::length(light.direction), 1.0, 1e-12);
    }
    EXPECT_NEAR(sum, expected, 0.005 * expected) << elevation;
  }
}

// Lights of a sky against rays, diffuse and glossy, with shadows: 1,024 lights are noise of 2 % where a
// shadow hides some of them, maps' outlines a pixel of 64 across the scene.
TEST_F(GatheredRays, NaturalLightComesToThatOfRays) {
  const scene::Scene scene = makeScene("resting_sphere");
  for (const double gloss : {0.0, 0.4}) {
    const Given surface = {{"receivers.share", gloss}, {"receivers.exponent", 10.0}};
    Given rays = surface;
    rays["rays"] = int64_t{1024};
    rays["light"] = std::string("sky");
    const Image truth = render(scene, "many_lods/ray_gathered", rays, {24, 18}).product;
    for (const char* shadows : {"rays", "polygons", "cuts"}) {
      Given lights = surface;
      lights["lights"] = int64_t{512};
      lights["shadows"] = std::string(shadows);
      if (std::string(shadows) == "cuts")
        lights["shadows.levels"] = int64_t{14}, lights["shadows.room"] = int64_t{8192};
      const Rendered made = render(scene, "many_lods/natural_illumination", lights, {24, 18}, true);
      if (std::string(shadows) == "cuts") {
        EXPECT_EQ(made.counter("refused_splits"), 0.0);
      }
      const Image& found = made.product;
      EXPECT_LT(meanDifference(found, truth), 0.05 * mean(truth)) << shadows << " " << gloss;
      EXPECT_NEAR(mean(found), mean(truth), 0.02 * mean(truth)) << shadows << " " << gloss;
    }
  }
}

// What references are worth: means of independent rays, whose error falls with the root of their number. Two
// sets of rays differ by the root of 2 of it, or less if they are spread evenly; of 256 pixels' sum of
// squares 30 % is four deviations and more.
TEST_F(GatheredRays, ErrorsFallWithTheRootOfTheRays) {
  const scene::Scene scene = makeScene("cornell_box");
  const auto square = [&](int64_t rays) {
    const auto picture = [&](int64_t seed) {
      return render(scene, "many_lods/ray_gathered", {{"rays", rays}, {"seed", seed}}, {16, 16}).product;
    };
    const Image a = picture(1), b = picture(2);
    double sum = 0.0;
    for (size_t i = 0; i < a.data.size(); ++i) sum += std::pow(double(a.data[i]) - b.data[i], 2.0);
    return sum;
  };
  const double few = square(64), many = square(1024);
  ASSERT_GT(many, 0.0);
  EXPECT_GT(few / many, 0.7 * 16.0);
}

}  // namespace
}  // namespace limen::techniques
