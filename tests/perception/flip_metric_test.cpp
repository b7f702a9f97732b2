// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <limits>

#include "experiments/base/error.h"
#include "flip_reference.h"
#include "metric_helpers.h"
#include "perception/metrics/metric_gpu.h"
#include "renderer/gl/texture.h"

namespace limen::perception {
namespace {

class FlipMetric : public testing::Test {
 protected:
  static void SetUpTestSuite() { context_ = gl::createHeadlessContext(); }
  static void TearDownTestSuite() { context_.reset(); }
  void TearDown() override { EXPECT_NO_THROW(context_->checkDebugMessages()); }
  static std::unique_ptr<gl::Context> context_;
};
std::unique_ptr<gl::Context> FlipMetric::context_;

TEST_F(FlipMetric, ReportsMeanAndMapForAnyChannelCountWithOrWithoutTextures) {
  MetricGpu gpu(*context_);
  const Image a = randomImage(31, 18, 3, 1), b = randomImage(31, 18, 3, 2);
  const FlipReference expected = computeFlipReference(a, b, 67.02);
  ComparisonInput input = pairOf(a, b);
  input.gpu = &gpu;
  const MetricResult fromImages = measure("flip", input);
  EXPECT_NEAR(fromImages.value, expected.mean, 1e-5);
  EXPECT_EQ(fromImages.mapName, "flip");
  EXPECT_EQ(fromImages.evaluatedPixels, 31 * 18);
  ASSERT_TRUE(fromImages.map);
  EXPECT_EQ(fromImages.map->width, 31);

  Image wideA(31, 18, 4, 1.0F), wideB(31, 18, 4, 1.0F);
  for (int y = 0; y < 18; ++y)
    for (int x = 0; x < 31; ++x)
      for (int c = 0; c < 3; ++c) wideA.at(x, y, c) = a.at(x, y, c), wideB.at(x, y, c) = b.at(x, y, c);
  gl::Texture textureA(gl::Format::RGBA32F, {31, 18}), textureB(gl::Format::RGBA32F, {31, 18});
  textureA.write(wideA);
  textureB.write(wideB);
  input = pairOf(wideA, wideB);
  input.gpu = &gpu;
  input.testTexture = &textureA;
  input.referenceTexture = &textureB;
  EXPECT_EQ(measure("flip", input).map->data, fromImages.map->data);
}

TEST_F(FlipMetric, FollowsChangesOfSizeAndResolution) {
  MetricGpu gpu(*context_);
  for (const int size : {16, 40, 16})
    for (const double ppd : {30.0, 60.0}) {
      const Image a = randomImage(size, size, 3, 1), b = randomImage(size, size, 3, 2);
      ComparisonInput input = pairOf(a, b);
      input.gpu = &gpu;
      EXPECT_NEAR(measure("flip", input, {{"pixels_per_degree", ppd}}).value,
                  computeFlipReference(a, b, ppd).mean, 1e-5);
    }
}

TEST_F(FlipMetric, KeepsItsObjectsBetweenCalls) {
  MetricGpu gpu(*context_);
  const Image a = randomImage(16, 16, 1, 1);
  ComparisonInput input = pairOf(a, a);
  input.gpu = &gpu;
  EXPECT_EQ(measure("flip", input).value, 0.0);
  const void* kept = gpu.kept("flip").get();
  ASSERT_NE(kept, nullptr);
  measure("flip", input);
  EXPECT_EQ(gpu.kept("flip").get(), kept);
}

TEST_F(FlipMetric, RefusesWhatItCannotEvaluate) {
  MetricGpu gpu(*context_);
  const Image a(4, 4, 1, 0.5F), wider(5, 4, 1, 0.5F);
  EXPECT_THROW(measure("flip", pairOf(a, a)), Error);  // no GL context
  ComparisonInput input = pairOf(a, wider);
  input.gpu = &gpu;
  EXPECT_THROW(measure("flip", input), Error);
  Image broken = a;
  broken.data[3] = std::numeric_limits<float>::quiet_NaN();
  input = pairOf(a, broken);
  input.gpu = &gpu;
  EXPECT_THROW(measure("flip", input), Error);
  input = pairOf(a, a);
  input.gpu = &gpu;
  EXPECT_THROW(measure("flip", input, {{"pixels_per_degree", 0.5}}), Error);
}

TEST(Metrics, AllAreRegistered) {
  for (const char* name : {"rmse", "mae", "largest_error", "signed_error", "psnr", "p99_error", "ssim",
                           "de94", "flip", "non_finite", "leaks", "acne", "band_step"}) {
    const MetricInfo* info = MetricRegistry::instance().find(name);
    ASSERT_NE(info, nullptr) << name;
    EXPECT_FALSE(info->summary.empty()) << name;
  }
}

}  // namespace
}  // namespace limen::perception
