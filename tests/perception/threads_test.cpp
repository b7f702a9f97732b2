// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "experiments/base/cores.h"
#include "metric_helpers.h"

namespace limen::perception {
namespace {

class MetricOfPictures : public testing::TestWithParam<const char*> {
 protected:
  /// All that may run on several processors, where there are several, does so at this size.
  const int channels_ = GetParam() == std::string("discontinuity") ? 1 : 3;
  const Image test_ = randomImage(700, 301, channels_, 1), reference_ = randomImage(700, 301, channels_, 2);
};

TEST_P(MetricOfPictures, DoesNotDependOnTheNumberOfThreads) {
  const MetricResult many = measure(GetParam(), pairOf(test_, reference_));
  shareCores(1 << 20);
  EXPECT_EQ(cores(), 1U);
  const MetricResult one = measure(GetParam(), pairOf(test_, reference_));
  shareCores(1);
  EXPECT_EQ(many.value, one.value);
  EXPECT_EQ(many.evaluatedPixels, one.evaluatedPixels);
  ASSERT_EQ(many.map.has_value(), one.map.has_value());
  if (many.map) {
    EXPECT_EQ(many.map->data, one.map->data);
  }
}

TEST_P(MetricOfPictures, HasTheSameValueWithoutItsMap) {
  ComparisonInput input = pairOf(test_, reference_);
  const MetricResult with = measure(GetParam(), input);
  input.wantsMap = false;
  const MetricResult without = measure(GetParam(), input);
  EXPECT_EQ(with.value, without.value);
  EXPECT_EQ(with.evaluatedPixels, without.evaluatedPixels);
}

INSTANTIATE_TEST_SUITE_P(Metrics, MetricOfPictures,
                         testing::Values("rmse", "mae", "signed_error", "largest_error", "p99_error", "psnr",
                                         "ssim", "de94", "discontinuity"),
                         [](const auto& tried) { return std::string(tried.param); });

}  // namespace
}  // namespace limen::perception
