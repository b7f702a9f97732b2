// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <limits>

#include "experiments/base/error.h"
#include "tests/perception/metric_helpers.h"

namespace limen::perception {
namespace {

constexpr float kEnd = -1.0F;

double errorOf(const std::string& metric, const std::vector<float>& test,
               const std::vector<float>& reference) {
  const Image a = makeImage(static_cast<int>(test.size()), 1, 1, test);
  const Image b = makeImage(static_cast<int>(reference.size()), 1, 1, reference);
  ComparisonInput input = pairOf(a, b);
  input.depicts = Depicts::Items;
  return measure(metric, input).value;
}

struct Case {
  std::vector<float> test;
  double mismatches, setMismatches, countDifference;
};

// Counted by hand.
TEST(StreamErrors, CountWhatIsWrong) {
  const std::vector<float> reference = {3, 5, 8, 9, kEnd, kEnd};
  constexpr float kNotANumber = std::numeric_limits<float>::quiet_NaN();
  for (const Case& one : {Case{{3, 5, 8, 9, kEnd, kEnd}, 0, 0, 0},
                          {{5, 3, 8, 9, kEnd, kEnd}, 2, 0, 0},     // out of order
                          {{3, 8, 9, kEnd, kEnd, kEnd}, 3, 1, 1},  // an item is missing
                          {{3, 5, 8, 9, 9, kEnd}, 1, 1, 1},        // one is there twice
                          {{3, 5, 7, 9, kEnd, kEnd}, 1, 2, 0},     // one is another
                          {{kEnd, kEnd, kEnd, kEnd, kEnd, kEnd}, 4, 4, 4},
                          {{3, kNotANumber, 8, 9, kEnd, kEnd}, 1, 2, 0}}) {
    EXPECT_EQ(errorOf("stream_mismatches", one.test, reference), one.mismatches);
    EXPECT_EQ(errorOf("stream_set_mismatches", one.test, reference), one.setMismatches);
    EXPECT_EQ(errorOf("stream_count_difference", one.test, reference), one.countDifference);
  }
}

TEST(StreamErrors, RefusePictures) {
  const Image image = makeImage(2, 1, 1, {0.5F, 1.0F});
  EXPECT_THROW(valueOf("stream_mismatches", image, image), Error);
}

TEST(StreamErrors, AreRefusedAsPictures) {
  const Image stream = makeImage(2, 1, 1, {0.0F, kEnd});
  ComparisonInput input = pairOf(stream, stream);
  input.depicts = Depicts::Items;
  EXPECT_THROW(measure("rmse", input), Error);
}

}  // namespace
}  // namespace limen::perception
