// SPDX-License-Identifier: BSD-3-Clause
// The metric jnd against the predictor on the CPU.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/base/error.h"
#include "jnd_helpers.h"
#include "metric_helpers.h"
#include "perception/metrics/metric_texture.h"
#include "perception/metrics/quantile.h"
#include "perception/popping/predictor.h"
#include "popping_images.h"

namespace limen::perception {
namespace {

/// The GPU's map is within this share of its largest value (popping_gpu_test).
constexpr double kTolerance = 1e-3;

class JndMetric : public JndTest {
 protected:
  MetricResult jnd(ComparisonInput input, std::map<std::string, ParameterValue> given = {}) {
    input.gpu = &*gpu_;
    return measure("jnd", input, given);
  }

  /// What the metric should say of pictures that it shows as these, every pixel counting.
  static void expectPredictorsFigures(const MetricResult& result, const Image& shownTest,
                                      const Image& shownReference, const std::string& display) {
    const PoppingResult expected =
        predictPopping(linearPair(shownTest, shownReference), displayPreset(display));
    std::vector<double> sorted = expected.jndExact;
    const double largest = expected.summary.largestJnd, bound = kTolerance * largest;
    ASSERT_GT(largest, 2.0) << "nothing to see";
    ASSERT_EQ(result.figures.size(), 6U);
    EXPECT_NEAR(result.figures[kMedian], nearestRank(sorted, 0.5), bound);
    EXPECT_NEAR(result.figures[kP95], nearestRank(sorted, 0.95), bound);
    EXPECT_NEAR(result.figures[kLargest], largest, bound);
    // Pixels as close to 1 JND as the two may differ can be on either side.
    const auto pixels = static_cast<double>(sorted.size());
    const auto atLeast = [&](double jnd) {
      return static_cast<double>(
                 std::count_if(sorted.begin(), sorted.end(), [&](double value) { return value >= jnd; })) /
             pixels;
    };
    EXPECT_GE(result.figures[kShare], atLeast(1.0 + bound));
    EXPECT_LE(result.figures[kShare], atLeast(1.0 - bound));
    EXPECT_NEAR(result.figures[kRating], expected.summary.largestRating, 0.01);
    EXPECT_NEAR(result.figures[kDetection], expected.summary.detectionProbability, 0.01);
    for (size_t pixel = 0; pixel < sorted.size(); ++pixel)
      ASSERT_NEAR(result.map->data[pixel], expected.jndExact[pixel], bound) << pixel;
  }
};

TEST_F(JndMetric, ColourIsWhatThePredictorSaysOnTheCpu) {
  const Image test = sceneImage(kWidth, kHeight, 0.48), reference = sceneImage(kWidth, kHeight, 0.5);
  for (const char* display : {"desktop_24", "schwarz_2009"})
    expectPredictorsFigures(jnd(pairOf(test, reference), {{"display", std::string(display)}}), test,
                            reference, display);
}

TEST_F(JndMetric, ExposureScalesTheLightAndTheDisplayClips) {
  Image test = sceneImage(kWidth, kHeight, 0.48), reference = sceneImage(kWidth, kHeight, 0.5);
  const MetricResult result = jnd(pairOf(test, reference), {{"exposure", 2.0}});
  for (Image* image : {&test, &reference})
    for (float& value : image->data) value = std::min(2.0F * value, 1.0F);
  expectPredictorsFigures(result, test, reference, "desktop_24");
}

/// A shadow's edge: visibility rises over `width` pixels at x = at.
Image ramp(double at, double width) {
  Image out(kWidth, kHeight, 1);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      out.at(x, y) = static_cast<float>(std::clamp((x + 0.5 - at) / width, 0.0, 1.0));
  return out;
}

TEST_F(JndMetric, VisibilityAndLightColourAreShownOnTheSurfaces) {
  Image albedo = randomImage(kWidth, kHeight, 4, 3), direct = randomImage(kWidth, kHeight, 4, 4);
  for (int x = 0; x < kWidth; ++x)
    for (int c = 0; c < 4; ++c) albedo.at(x, 0, c) = -1.0F, direct.at(x, 0, c) = 0.0F;  // background
  const gl::Texture albedoTexture = metricTexture(albedo), directTexture = metricTexture(direct);
  const LitSurfaces surfaces{&albedoTexture, &directTexture};
  const auto shownOf = [&](const Image& product) {
    Image out(kWidth, kHeight, 3);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        for (int c = 0; c < 3; ++c) {
          const double share = product.at(x, y, product.channels == 1 ? 0 : c);
          out.at(x, y, c) = static_cast<float>(
              y == 0 ? 0.125 : 0.25 * albedo.at(x, y, c) + 0.75 * direct.at(x, y, c) * share);
        }
    return out;
  };
  const std::map<std::string, ParameterValue> shares = {
      {"ambient", 0.25}, {"diffuse", 0.75}, {"background", 0.125}};
  const Image test = ramp(40.0, 2.0), reference = ramp(38.0, 12.0);
  ComparisonInput input = pairOf(test, reference);
  input.depicts = Depicts::ShareOfLight;
  input.surfaces = &surfaces;
  expectPredictorsFigures(jnd(input, shares), shownOf(test), shownOf(reference), "desktop_24");

  Image warm(kWidth, kHeight, 4, 1.0F), cool(kWidth, kHeight, 4, 1.0F);
  for (size_t pixel = 0; pixel < warm.pixels(); ++pixel)
    for (size_t c = 0; c < 3; ++c) {
      warm.data[4 * pixel + c] = c == 2 ? reference.data[pixel] : test.data[pixel];
      cool.data[4 * pixel + c] = reference.data[pixel];
    }
  input.test = &warm;
  input.reference = &cool;
  expectPredictorsFigures(jnd(input, shares), shownOf(warm), shownOf(cool), "desktop_24");

  input.surfaces = nullptr;
  EXPECT_THROW(jnd(input), Error) << "nothing to show it on";
  input.depicts = Depicts::Nothing;
  EXPECT_THROW(jnd(input), Error) << "not a picture";
}

TEST_F(JndMetric, EqualProductsDifferByNothing) {
  const Image image = randomImage(kWidth, kHeight, 3, 1);
  const MetricResult result = jnd(pairOf(image, image));
  for (const int figure : {kMedian, kP95, kLargest, kShare}) EXPECT_EQ(result.figures[figure], 0.0);
  EXPECT_EQ(result.figures[kDetection], DetectionModel{}.guessRate);
  EXPECT_LT(result.figures[kRating], poppingRating(PoppingSettings{}.regions.thresholdJnd));
  EXPECT_TRUE(std::isfinite(result.figures[kRating]));
}

// The mask selects pixels of the map, which itself is that of the whole picture.
TEST_F(JndMetric, PixelFiguresAreExactQuantilesOverTheRegion) {
  const Image test = randomImage(kWidth, kHeight, 1, 1), reference = randomImage(kWidth, kHeight, 1, 2);
  Image mask(kWidth, kHeight, 1);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) mask.at(x, y) = (x * 7 + y * 3) % 5 == 0 ? 1.0F : 0.0F;
  for (const bool masked : {true, false}) {
    const MetricResult result = jnd(pairOf(test, reference, masked ? &mask : nullptr));
    std::vector<double> values;
    for (size_t pixel = 0; pixel < mask.pixels(); ++pixel)
      if (!masked || mask.data[pixel] > 0.5F) values.push_back(result.map->data[pixel]);
    EXPECT_EQ(result.evaluatedPixels, static_cast<int64_t>(values.size()));
    EXPECT_EQ(result.figures[kMedian], nearestRank(values, 0.5));
    EXPECT_EQ(result.figures[kP95], nearestRank(values, 0.95));
    EXPECT_EQ(result.figures[kLargest], *std::max_element(values.begin(), values.end()));
    const auto visible =
        std::count_if(values.begin(), values.end(), [](double value) { return value >= 1.0; });
    EXPECT_EQ(result.figures[kShare], static_cast<double>(visible) / static_cast<double>(values.size()));
  }
  mask = Image(kWidth, kHeight, 1);
  const MetricResult none = jnd(pairOf(test, reference, &mask));
  EXPECT_EQ(none.evaluatedPixels, 0);
  for (const int figure : {kMedian, kP95, kLargest, kShare}) EXPECT_EQ(none.figures[figure], 0.0);
}

// As the errors of other metrics: the whole range of a product.
TEST_F(JndMetric, ANonFiniteValueShowsWhatIsFartherFromTheReference) {
  const Image reference = sceneImage(kWidth, kHeight, 0.5);
  Image broken = reference, farther = reference;
  for (int y = 30; y < 34; ++y)
    for (int x = 20; x < 24; ++x)
      for (int c = 0; c < 3; ++c) {
        broken.at(x, y, c) = c == 0   ? std::numeric_limits<float>::quiet_NaN()
                             : c == 1 ? std::numeric_limits<float>::infinity()
                                      : -std::numeric_limits<float>::infinity();
        farther.at(x, y, c) = reference.at(x, y, c) < 0.5F ? 1.0F : 0.0F;
      }
  EXPECT_EQ(jnd(pairOf(broken, reference)).map->data, jnd(pairOf(farther, reference)).map->data);
  EXPECT_THROW(jnd(pairOf(reference, broken)), Error);
}

TEST_F(JndMetric, KeepsItsObjectsBetweenCallsAndFollowsSizes) {
  const Image a = randomImage(40, 30, 3, 1), b = randomImage(40, 30, 3, 2);
  const MetricResult first = jnd(pairOf(a, b));
  const double compiled = context().programs().compileMs();
  const Image small = randomImage(24, 33, 3, 1);
  EXPECT_EQ(jnd(pairOf(small, small)).figures[kLargest], 0.0);
  EXPECT_EQ(jnd(pairOf(a, b)).map->data, first.map->data);
  EXPECT_EQ(context().programs().compileMs(), compiled);
}

TEST_F(JndMetric, PicturesAreMadeOnDemand) {
  const Image test = sceneImage(kWidth, kHeight, 0.4), reference = sceneImage(kWidth, kHeight, 0.5);
  ComparisonInput input = pairOf(test, reference);
  EXPECT_TRUE(jnd(input).pictures.empty());
  input.wantsPictures = input.wantsLight = true;
  const MetricResult result = jnd(input);
  ASSERT_EQ(result.pictures.size(), 3U);
  EXPECT_EQ(result.pictures[0].name, "jnd_regions");
  EXPECT_EQ(result.pictures[1].image.data, test.data) << "shown as it is: within the display's range";
  EXPECT_EQ(result.pictures[2].image.data, reference.data);
}

}  // namespace
}  // namespace limen::perception
