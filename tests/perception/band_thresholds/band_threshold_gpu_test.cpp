// SPDX-License-Identifier: BSD-3-Clause
#include "perception/band_thresholds/band_threshold_gpu.h"

#include <gtest/gtest.h>

#include "experiments/base/error.h"
#include "perception/band_thresholds/reference.h"
#include "perception/threshold_maps/reference.h"
#include "tests/perception/band_thresholds/natural_images.h"
#include "tests/perception/threshold_maps/patterns.h"
#include "tests/renderer/gl/gl_fixture.h"

namespace limen::perception {
namespace {

/// Tables are interpolated linearly: 32 segments per octave of contrast, 1000 cells per decade of luminance.
constexpr double kTolerance = 0.005;

class BandThresholdGpuTest : public gl::GlTest {
 protected:
  static DisplayProfile display() { return displayPreset("schwarz_2009"); }

  static void compare(const Image& got, const Plane& exact, const std::string& name) {
    ASSERT_EQ(got.data.size(), exact.data.size()) << name;
    double largest = 0.0;
    for (size_t i = 0; i < got.data.size(); ++i) {
      ASSERT_TRUE(std::isfinite(got.data[i])) << name;
      largest = std::max(largest, std::abs(got.data[i] / exact.data[i] - 1.0));
    }
    EXPECT_LT(largest, kTolerance) << name;
  }

  /// Combined map and every band against the reference.
  static void compareAll(const Plane& luminance, const BandThresholdSettings& settings,
                         const std::string& name) {
    gl::Texture input(gl::Format::R32F, {luminance.width, luminance.height});
    input.write(toImage(luminance));
    BandThresholdGpu gpu(context(), input.sizePx(), display(), settings, false);
    gpu.keepBands();
    const BandThresholds exact = computeBandThresholds(luminance, display(), settings);
    compare(gpu.run(input).read(), thresholdMapOf(exact, settings), name);
    ASSERT_EQ(gpu.bands(), static_cast<int>(exact.bands.size()));
    for (int band = 0; band < gpu.bands(); ++band)
      compare(gpu.debugViews().at("bands")->read(band), exact.bands[static_cast<size_t>(band)].thresholdCdM2,
              name + ", band " + std::to_string(band));
  }
};

TEST_F(BandThresholdGpuTest, AgreesWithTheReferenceOnAdversarialImages) {
  for (const auto& [name, image] : adversarialPatterns()) compareAll(image, {}, name);
}

TEST_F(BandThresholdGpuTest, AgreesWithTheReferenceOnPictures) {
  for (int index = 0; index < kNaturalImages; index += 3)
    compareAll(naturalImage(index, 201 + index, 150, display().blackLevelCdM2(), display().whiteLevelCdM2()),
               {}, "image " + std::to_string(index));
}

TEST_F(BandThresholdGpuTest, AgreesWithTheReferenceForEverySetting) {
  const Plane image = picture(150, 101);
  const auto with = [](const auto& change) {
    BandThresholdSettings settings;
    change(settings);
    return settings;
  };
  compareAll(image, with([](auto& s) { s.reach = 0; }), "reach 0");
  compareAll(image, with([](auto& s) { s.reach = kMostReach; }), "reach 4");
  compareAll(image, with([](auto& s) { s.jnd = 3.0; }), "3 JND");
  compareAll(image, with([](auto& s) { s.output = BandOutput{0}; }), "band 0");
  compareAll(image, with([](auto& s) { s.output = BandOutput{3}; }), "band 3");
  compareAll(image, with([](auto& s) { s.predictor.masking = {"daly", {}}; }), "daly");
  compareAll(image, with([](auto& s) { s.predictor.masking = {"none", {}}; }), "no masking");
  compareAll(image, with([](auto& s) { s.predictor.adaptation = FixedAdaptation{20.0}; }), "fixed");
  compareAll(image, with([](auto& s) { s.predictor.adaptation = LevelAdaptation{2}; }), "level 2");
  compareAll(image, with([](auto& s) { s.predictor.bands.kernelCentre = 0.5; }), "kernel");
}

TEST_F(BandThresholdGpuTest, APartOfTheMapIsThatPartOfTheWholeMap) {
  const Plane luminance = picture(201, 143);
  gl::Texture input(gl::Format::R32F, {201, 143}), flat(gl::Format::R32F, {201, 143});
  input.write(toImage(luminance));
  flat.clear(glm::vec4(50.0F));
  for (const bool one : {false, true}) {
    BandThresholdSettings settings;
    if (one) settings.output = BandOutput{2};
    BandThresholdGpu gpu(context(), input.sizePx(), display(), settings, false);
    const Image whole = gpu.run(input).read();
    for (const MapArea area : {MapArea{{70, 41}, {90, 80}}, MapArea{{0, 0}, {1, 1}},
                               MapArea{{63, 31}, {66, 34}}, MapArea{{190, 100}, {201, 143}}}) {
      gpu.run(flat);  // so that nothing is left of the last run
      const Image part = gpu.run(input, nullptr, area).read();
      for (int y = area.low.y; y < area.high.y; ++y)
        for (int x = area.low.x; x < area.high.x; ++x)
          ASSERT_EQ(part.data[size_t(y) * 201 + size_t(x)], whole.data[size_t(y) * 201 + size_t(x)])
              << x << ", " << y;
    }
  }
}

TEST_F(BandThresholdGpuTest, ColourIsTurnedIntoTheDisplaysLuminance) {
  Image colour(70, 40, 4);
  for (size_t i = 0; i < colour.data.size(); ++i) colour.data[i] = static_cast<float>((i * 37 % 101) / 80.0);
  colour.data[0] = std::nanf("");
  colour.data[5] = -1.0F;
  gl::Texture input(gl::Format::RGBA32F, {70, 40});
  input.write(colour);
  BandThresholdGpu gpu(context(), {70, 40}, display(), {});
  compare(gpu.run(input).read(),
          computeBandThresholds(luminancePlane(colour, display()), display(), {}).combinedCdM2, "colour");
}

TEST_F(BandThresholdGpuTest, RefusesWhatItDoesNotCompute) {
  const auto make = [&](const BandThresholdSettings& settings) {
    BandThresholdGpu(context(), {64, 64}, display(), settings, false);
  };
  BandThresholdSettings settings;
  settings.predictor.adaptation = MeanAdaptation{};
  EXPECT_THROW(make(settings), Error);
  settings = {};
  settings.predictor.bands.decomposition = PyramidBands{PyramidUpsampler::Linear};
  EXPECT_THROW(make(settings), Error);
  settings = {};
  settings.output = BandOutput{9};
  EXPECT_THROW(make(settings), Error);
  settings = {};
  settings.predictor.bands.weights = FittedWeights{};
  EXPECT_THROW(make(settings), Error);
}

}  // namespace
}  // namespace limen::perception
