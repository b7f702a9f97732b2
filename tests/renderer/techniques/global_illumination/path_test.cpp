// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

class Paths : public TechniqueTest {
 protected:
  static constexpr const char *kGpu = "global_illumination/path_traced",
                              *kCpu = "global_illumination/path_reference";

  static double meanOf(const Image& picture) {
    double sum = 0.0;
    for (size_t pixel = 0; pixel < picture.pixels(); ++pixel)
      for (size_t c = 0; c < 3; ++c) sum += picture.data[4 * pixel + c];
    return sum / (3.0 * double(picture.pixels()));
  }
};

/// All walls emit e and reflect a: after n reflections every point has the radiance e (1 + a + ... + a^n),
/// whatever the directions, so that every path has it exactly. What is left is rounding: a product and a sum
/// for each reflection, and a sum of 4 paths, each with an error of 2^-24 of the whole: 20 * 2^-24 < 2e-6.
TEST_F(Paths, ClosedBoxHasThePartialSumOfItsRadiosity) {
  const double albedo = 0.75, emission = 0.5;
  const scene::Scene scene =
      makeScene("global_illumination/closed_box", {{"albedo", albedo}, {"emission", emission}});
  for (const char* technique : {kGpu, kCpu})
    for (const int64_t bounces : {0, 1, 3, 8}) {
      const double whole = emission * (1.0 - std::pow(albedo, double(bounces) + 1.0)) / (1.0 - albedo);
      for (const char* light : {"all", "direct", "indirect"}) {
        const std::string part = light;
        const double expected = part == "all" ? whole : part == "direct" ? emission : whole - emission;
        const Rendered rendered = render(
            scene, technique, {{"paths", int64_t{4}}, {"bounces", bounces}, {"light", part}}, {16, 12});
        for (size_t i = 0; i < rendered.product.pixels(); ++i)
          for (size_t c = 0; c < 3; ++c)
            ASSERT_NEAR(rendered.product.data[4 * i + c], expected, 2e-6 * whole)
                << technique << ", " << bounces << " bounces, " << part << ", pixel " << i;
      }
    }
}

/// A horizontal surface below a black one that emits, both wide: the form factor of a point below the middle
/// of a rectangle 2a x 2b at height h (Howell's catalogue, B-3, four corners) gives the radiance albedo * e *
/// F. A path brings albedo * e or nothing, so that the standard deviation of a mean of N is at most albedo *
/// e / (2 sqrt(N)); allowed are 4 of them (6e-5 of all runs).
TEST_F(Paths, AnEmittingPanelHasItsFormFactor) {
  const double a = 0.8, b = 0.5, h = 0.7, albedo = 0.6, emission = 3.0;
  scene::Scene scene;
  scene::Material panel, floor;
  panel.name = "panel", floor.name = "floor";
  panel.albedo = glm::vec3(0.0F), floor.albedo = glm::vec3(static_cast<float>(albedo));
  panel.emission = glm::vec3(static_cast<float>(emission));
  scene::addPart(scene, scene::card({0.0, h, 0.0}, {a, 0.0, 0.0}, {0.0, 0.0, b}), panel);
  scene::addPart(scene, scene::planeGrid(glm::dvec3(0.0), 4.0, 4.0, 1), floor);
  scene::setStillCamera(scene, {{0.05, 0.4, 0.6}, glm::dvec3(0.0), {0.0, 1.0, 0.0}, 0.01});
  const double x = a / h, y = b / h, rx = std::sqrt(1.0 + x * x), ry = std::sqrt(1.0 + y * y);
  const double factor =
      4.0 / (2.0 * 3.14159265358979) * (x / rx * std::atan(y / rx) + y / ry * std::atan(x / ry));
  constexpr int64_t kCount = 4096;
  const double bound = 4.0 * albedo * emission / (2.0 * std::sqrt(double(kCount)));
  for (const char* technique : {kGpu, kCpu}) {
    const Rendered rendered =
        render(scene, technique, {{"paths", kCount}, {"bounces", int64_t{1}}}, {1, 1}, true);
    EXPECT_NEAR(rendered.product.data[0], albedo * emission * factor, bound) << technique;
    // What it says of itself: a path brings albedo * e with the probability F.
    EXPECT_NEAR(rendered.counter("standard_error"),
                albedo * emission * std::sqrt(factor * (1.0 - factor) / double(kCount)),
                0.1 * albedo * emission / std::sqrt(double(kCount)))
        << technique;
  }
}

/// GPU and CPU share neither directions nor code. The mean over a picture has, pixels being independent, a
/// standard error of the stated root mean square over the square root of the number of pixels; four of the
/// two together are allowed. So are, for pixels, six of the root mean square for all but 1 in 100, which has
/// room for pixels noisier than the mean and for edges.
TEST_F(Paths, BothTracersAgreeWithinTheirStandardErrors) {
  struct Case {
    const char* scene;
    Given given;
    int64_t bounces;
  };
  const Case cases[] = {{"global_illumination/room", {}, 2},
                        {"global_illumination/room", {{"lit_by", std::string("emitters")}}, 2},
                        {"global_illumination/divided_room", {{"transmittance", 0.5}}, 3},
                        {"global_illumination/slanted_wall", {}, 2},
                        {"cornell_box", {}, 4}};
  for (const Case& each : cases) {
    const scene::Scene scene = makeScene(each.scene, each.given);
    const Given given = {
        {"paths", int64_t{64}}, {"bounces", each.bounces}, {"light", std::string("indirect")}};
    const Rendered gpu = render(scene, kGpu, given, {32, 24}, true),
                   cpu = render(scene, kCpu, given, {32, 24}, true);
    const double error = std::hypot(gpu.counter("standard_error"), cpu.counter("standard_error"));
    EXPECT_GT(meanOf(cpu.product), 0.0) << each.scene;
    EXPECT_NEAR(meanOf(gpu.product), meanOf(cpu.product), 4.0 * error / std::sqrt(32.0 * 24.0)) << each.scene;
    int beyond = 0;
    for (size_t i = 0; i < gpu.product.pixels(); ++i) {
      double difference = 0.0;
      for (size_t c = 0; c < 3; ++c)
        difference += (double(gpu.product.data[4 * i + c]) - cpu.product.data[4 * i + c]) / 3.0;
      beyond += std::abs(difference) > 6.0 * error;
    }
    EXPECT_LE(beyond, 32 * 24 / 100) << each.scene;
  }
}

/// Nothing passes a closed wall; of light that only passes once, half passes a half-transparent one: with
/// black surfaces around, what reaches a point behind is the emitter's light times the transmittance. The
/// ratio of two independent means: 4 standard errors of each.
TEST_F(Paths, WallsPassTheirShare) {
  const auto behind = [&](double transmittance, const char* technique) {
    const scene::Scene scene =
        makeScene("global_illumination/divided_room", {{"transmittance", transmittance}, {"albedo", 0.5}});
    const Rendered rendered =
        render(scene, technique,
               {{"paths", int64_t{256}}, {"bounces", int64_t{1}}, {"light", std::string("indirect")}},
               {32, 24}, true);
    double sum = 0.0;
    int count = 0;
    // The right room, seen through the open front.
    for (int y = 0; y < 24; ++y)
      for (int x = 18; x < 32; ++x) sum += rendered.product.at(x, y), ++count;
    return std::pair(sum / count, rendered.counter("standard_error") / std::sqrt(double(count)));
  };
  for (const char* technique : {kGpu, kCpu}) {
    EXPECT_EQ(behind(0.0, technique).first, 0.0) << technique;
    const auto whole = behind(1.0, technique), half = behind(0.5, technique);
    EXPECT_GT(whole.first, 10.0 * whole.second);
    // A path that passes has the whole share, whatever the transmittance.
    EXPECT_NEAR(half.first, 0.5 * whole.first, 4.0 * (half.second + 0.5 * whole.second)) << technique;
  }
}

/// The same seed gives the same bytes, another seed others.
TEST_F(Paths, TheSeedDecides) {
  const scene::Scene scene = makeScene("global_illumination/room");
  for (const char* technique : {kGpu, kCpu}) {
    const auto product = [&](int64_t seed) {
      return render(scene, technique, {{"paths", int64_t{2}}, {"seed", seed}}, {8, 8}).product.data;
    };
    EXPECT_EQ(product(1), product(1));
    EXPECT_NE(product(1), product(2));
  }
}

}  // namespace
}  // namespace limen::techniques
