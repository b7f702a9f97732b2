// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "experiments/base/error.h"
#include "metric_helpers.h"

namespace limen::perception {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();
const std::vector<std::string> kErrors = {"rmse", "mae", "largest_error", "signed_error", "p99_error"};

ParameterValue region(const char* name) { return std::string(name); }

// Errors 0, 1/4, 0, -1/2: mean |e| = 3/16, mean e^2 = 5/64, mean e = -1/16.
TEST(PixelErrors, TwoByTwoImageByHand) {
  const Image test = makeImage(2, 2, 1, {0.0F, 0.5F, 1.0F, 0.25F});
  const Image reference = makeImage(2, 2, 1, {0.0F, 0.25F, 1.0F, 0.75F});
  EXPECT_DOUBLE_EQ(valueOf("mae", test, reference), 3.0 / 16.0);
  EXPECT_DOUBLE_EQ(valueOf("rmse", test, reference), std::sqrt(5.0 / 64.0));
  EXPECT_DOUBLE_EQ(valueOf("signed_error", test, reference), -1.0 / 16.0);
  EXPECT_DOUBLE_EQ(valueOf("largest_error", test, reference), 0.5);
  EXPECT_DOUBLE_EQ(valueOf("p99_error", test, reference), 0.5);
  EXPECT_DOUBLE_EQ(valueOf("psnr", test, reference), 10.0 * std::log10(64.0 / 5.0));
}

TEST(PixelErrors, MapHoldsEachPixelsAbsoluteError) {
  const Image test = makeImage(2, 1, 1, {0.5F, 0.25F}), reference = makeImage(2, 1, 1, {0.25F, 0.75F});
  const MetricResult result = measure("rmse", pairOf(test, reference));
  ASSERT_TRUE(result.map);
  EXPECT_EQ(result.mapName, "absolute_error");
  EXPECT_EQ(result.map->data, (std::vector<float>{0.25F, 0.5F}));
}

// Channel errors 1/2, 0, -1/4 in one pixel, none in the other: mean e^2 = (1/4 + 1/16) / 6.
TEST(PixelErrors, ColourIsAveragedOverThreeChannelsWithoutAlpha) {
  const Image test = makeImage(2, 1, 4, {0.5F, 0.0F, 0.5F, 0.0F, 1.0F, 1.0F, 1.0F, 9.0F});
  const Image reference = makeImage(2, 1, 4, {0.0F, 0.0F, 0.75F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F});
  EXPECT_DOUBLE_EQ(valueOf("rmse", test, reference), std::sqrt((0.25 + 0.0625) / 6.0));
  EXPECT_DOUBLE_EQ(valueOf("mae", test, reference), 0.75 / 6.0);
  EXPECT_DOUBLE_EQ(valueOf("largest_error", test, reference), 0.5);
}

// One error each of 0.00 to 0.99: 99 of the 100 do not exceed 0.98.
TEST(PixelErrors, Percentile99IsTheNearestRank) {
  Image test(10, 10, 1), reference(10, 10, 1);
  for (size_t i = 0; i < 100; ++i) test.data[(i * 37) % 100] = static_cast<float>(i) / 100.0F;
  EXPECT_EQ(valueOf("p99_error", test, reference), double{0.98F});
}

TEST(PixelErrors, PsnrOfAKnownRmse) {
  const Image reference(3, 2, 1, 0.5F);
  EXPECT_NEAR(valueOf("psnr", Image(3, 2, 1, 0.6F), reference), 20.0, 1e-5);
  EXPECT_NEAR(valueOf("psnr", Image(3, 2, 1, 0.51F), reference), 40.0, 1e-4);
}

TEST(PixelErrors, EqualImagesHaveNoErrorAndTheCappedPsnr) {
  const Image image = randomImage(9, 7, 1, 3);
  for (const std::string& name : kErrors) EXPECT_EQ(valueOf(name, image, image), 0.0) << name;
  EXPECT_EQ(valueOf("psnr", image, image), 200.0);
}

TEST(PixelErrors, RegionsSelectPixels) {
  // Receivers: the first three pixels. Penumbra: the second and third.
  const Image mask = makeImage(4, 1, 1, {1.0F, 1.0F, 1.0F, 0.0F});
  const Image reference = makeImage(4, 1, 1, {1.0F, 0.5F, 0.25F, 0.5F});
  const Image test = makeImage(4, 1, 1, {0.0F, 0.75F, 0.25F, 1.0F});  // errors -1, 1/4, 0, 1/2
  const ComparisonInput input = pairOf(test, reference, &mask);
  const MetricResult all = measure("mae", input, {{"region", region("all")}});
  const MetricResult receivers = measure("mae", input);
  const MetricResult penumbra = measure("mae", input, {{"region", region("penumbra")}});
  EXPECT_EQ(all.evaluatedPixels, 4);
  EXPECT_DOUBLE_EQ(all.value, 1.75 / 4.0);
  EXPECT_EQ(receivers.evaluatedPixels, 3);
  EXPECT_DOUBLE_EQ(receivers.value, 1.25 / 3.0);
  EXPECT_EQ(receivers.map->data, (std::vector<float>{1.0F, 0.25F, 0.0F, 0.0F}));
  EXPECT_EQ(penumbra.evaluatedPixels, 2);
  EXPECT_DOUBLE_EQ(penumbra.value, 0.125);
}

TEST(PixelErrors, ReflectorsAreThePixelsThatSeeMirrors) {
  // Receivers: the first three pixels. Mirrors: the third and fourth.
  const Image mask = makeImage(4, 1, 1, {1.0F, 1.0F, 1.0F, 0.0F});
  const Image mirrors = makeImage(4, 1, 1, {0.0F, 0.0F, 1.0F, 1.0F});
  const Image reference = makeImage(4, 1, 1, {1.0F, 0.5F, 0.25F, 0.5F});
  const Image test = makeImage(4, 1, 1, {0.0F, 0.75F, 0.0F, 1.0F});  // errors -1, 1/4, -1/4, 1/2
  ComparisonInput input = pairOf(test, reference, &mask);
  EXPECT_THROW(measure("mae", input, {{"region", region("reflectors")}}), Error);
  input.mirrors = &mirrors;
  const MetricResult result = measure("mae", input, {{"region", region("reflectors")}});
  EXPECT_EQ(result.evaluatedPixels, 2);
  EXPECT_DOUBLE_EQ(result.value, 0.375);
}

TEST(PixelErrors, EmptyRegionIsEvaluatedPerfectAndSaysSo) {
  const Image mask(2, 2, 1, 0.0F), reference(2, 2, 1, 1.0F), test(2, 2, 1, 0.0F);
  for (const std::string& name : kErrors) {
    const MetricResult result = measure(name, pairOf(test, reference, &mask));
    EXPECT_EQ(result.value, 0.0) << name;
    EXPECT_EQ(result.evaluatedPixels, 0) << name;
  }
  EXPECT_EQ(measure("psnr", pairOf(test, reference, &mask)).value, 200.0);
  EXPECT_EQ(measure("de94", pairOf(test, reference, &mask)).value, 0.0);
  EXPECT_EQ(valueOf("mae", test, reference, {{"region", region("penumbra")}}), 0.0);
}

TEST(PixelErrors, ColourHasNoPenumbra) {
  const Image colour(2, 2, 4, 0.5F);
  EXPECT_THROW(valueOf("rmse", colour, colour, {{"region", region("penumbra")}}), Error);
}

TEST(PixelErrors, NonFiniteTestValuesCountAsAnErrorOfOne) {
  const Image reference(4, 1, 1, 0.5F);
  const Image test = makeImage(4, 1, 1, {kNan, kInfinity, -kInfinity, 0.5F});
  EXPECT_DOUBLE_EQ(valueOf("mae", test, reference), 0.75);
  EXPECT_DOUBLE_EQ(valueOf("rmse", test, reference), std::sqrt(0.75));
  EXPECT_DOUBLE_EQ(valueOf("signed_error", test, reference), 0.25);
  EXPECT_DOUBLE_EQ(valueOf("largest_error", test, reference), 1.0);
  EXPECT_EQ(valueOf("non_finite", test, reference), 3.0);
  for (const char* name : {"ssim", "de94", "psnr", "p99_error", "leaks", "acne", "band_step"})
    EXPECT_TRUE(std::isfinite(valueOf(name, test, reference))) << name;
}

TEST(PixelErrors, NonFiniteReferenceIsRefused) {
  const Image test(2, 1, 1, 0.5F), reference = makeImage(2, 1, 1, {0.5F, kNan});
  for (const char* name : {"rmse", "psnr", "ssim", "de94", "leaks", "acne", "band_step"})
    EXPECT_THROW(valueOf(name, test, reference), Error) << name;
}

TEST(PixelErrors, NonFiniteCountsEveryChannelAndNeedsNoReference) {
  const Image test = makeImage(1, 2, 4, {kNan, 0, 0, kInfinity, 1, 2, -kInfinity, 1});
  ComparisonInput input;
  input.test = &test;
  EXPECT_EQ(measure("non_finite", input).value, 3.0);
  EXPECT_FALSE(MetricRegistry::instance().get("non_finite").needsReference);
}

TEST(PixelErrors, OnePixelImage) {
  const Image test(1, 1, 1, 0.75F), reference(1, 1, 1, 0.5F);
  for (const char* name : {"rmse", "mae", "largest_error", "signed_error", "p99_error"})
    EXPECT_DOUBLE_EQ(valueOf(name, test, reference), 0.25) << name;
}

TEST(PixelErrors, UnequalImagesAreRefused) {
  const Image a(2, 2, 1), wider(3, 2, 1), colour(2, 2, 4), mask(1, 2, 1);
  EXPECT_THROW(valueOf("rmse", a, wider), Error);
  EXPECT_THROW(valueOf("rmse", a, colour), Error);
  EXPECT_THROW(measure("rmse", pairOf(a, a, &mask)), Error);
  EXPECT_THROW(measure("rmse", ComparisonInput{}), Error);
}

// Every error is the float nearest 0.1; a naive sum of two million of them is off by 1e-10 or more.
TEST(PixelErrors, LargeSumsLoseNothingAndRepeatExactly) {
  const Image test(2000, 1000, 1, 0.1F), reference(2000, 1000, 1, 0.0F);
  EXPECT_NEAR(valueOf("mae", test, reference), double{0.1F}, 1e-16);
  const Image a = randomImage(1024, 512, 1, 1), b = randomImage(1024, 512, 1, 2);
  for (const char* name : {"rmse", "signed_error", "ssim", "de94"})
    EXPECT_EQ(valueOf(name, a, b), valueOf(name, a, b)) << name;
}

}  // namespace
}  // namespace limen::perception
