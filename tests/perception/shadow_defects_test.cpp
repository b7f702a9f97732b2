// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <limits>

#include "experiments/base/error.h"
#include "metric_helpers.h"

namespace limen::perception {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// In full shadow: excess of 0.1 (leak), of 0.04 (none), 0.06 over a reference of 0.01 (leak). Excess outside
// full shadow is no leak. Five receivers.
TEST(Leaks, CountsLightInFullShadowOnly) {
  const Image reference = makeImage(6, 1, 1, {0.0F, 0.0F, 0.01F, 0.03F, 1.0F, 0.0F});
  const Image test = makeImage(6, 1, 1, {0.1F, 0.04F, 0.07F, 0.5F, 1.0F, 1.0F});
  const Image mask = makeImage(6, 1, 1, {1, 1, 1, 1, 1, 0});
  const MetricResult result = measure("leaks", pairOf(test, reference, &mask));
  EXPECT_DOUBLE_EQ(result.value, 2.0 / 5.0);
  EXPECT_EQ(result.evaluatedPixels, 5);
  EXPECT_EQ(result.map->at(1, 0), 0.0F);
  EXPECT_FLOAT_EQ(result.map->at(0, 0), 0.1F);
}

TEST(Acne, CountsDarkSpotsInFullLightOnly) {
  const Image reference = makeImage(5, 1, 1, {1.0F, 1.0F, 1.0F, 0.999F, 0.0F});
  const Image test = makeImage(5, 1, 1, {0.97F, 0.985F, 0.0F, 0.0F, 0.0F});
  const MetricResult result = measure("acne", pairOf(test, reference));
  EXPECT_DOUBLE_EQ(result.value, 2.0 / 5.0);
  EXPECT_FLOAT_EQ(result.map->at(2, 0), 1.0F);
}

// In row 1: lit where there is shadow in pixels 1 to 3, then half-lit (excess 0.2: none), then 5, which is
// lit in the reference too. Column 2 goes on in row 2: runs of 3 and 2.
TEST(ContactGap, IsTheLongestRunOfTooLightPixelsInShadow) {
  const Image reference = makeImage(6, 3, 1,
                                    {0.6F, 0.6F, 0.6F, 0.6F, 0.6F, 0.6F,   //
                                     0.0F, 0.0F, 0.3F, 0.49F, 0.3F, 1.0F,  //
                                     0.0F, 0.0F, 0.1F, 0.0F, 0.0F, 0.0F});
  const Image test = makeImage(6, 3, 1,
                               {1.0F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F,  //
                                0.1F, 1.0F, 0.6F, 0.8F, 0.5F, 1.0F,  //
                                0.0F, 0.0F, 0.4F, 0.0F, 0.0F, 0.0F});
  EXPECT_EQ(valueOf("contact_gap", test, reference), 3.0);
  const Image upright = makeImage(1, 4, 1, {0.0F, 1.0F, kNan, 1.0F}), shadow(1, 4, 1, 0.0F);
  EXPECT_EQ(valueOf("contact_gap", upright, shadow), 3.0);
  const Image mask = makeImage(1, 4, 1, {1, 1, 0, 1});
  EXPECT_EQ(measure("contact_gap", pairOf(upright, shadow, &mask)).value, 1.0);
}

TEST(ShadowDefects, NonFiniteValuesAreDefects) {
  const Image test = makeImage(2, 1, 1, {kNan, kNan}), reference = makeImage(2, 1, 1, {0.0F, 1.0F});
  EXPECT_DOUBLE_EQ(valueOf("leaks", test, reference), 0.5);
  EXPECT_DOUBLE_EQ(valueOf("acne", test, reference), 0.5);
}

TEST(ShadowDefects, NoReceiversNoDefects) {
  const Image test(2, 2, 1, 0.5F), reference(2, 2, 1, 0.0F), mask(2, 2, 1, 0.0F);
  for (const char* name : {"leaks", "acne", "contact_gap", "band_step", "discontinuity"}) {
    const MetricResult result = measure(name, pairOf(test, reference, &mask));
    EXPECT_EQ(result.value, 0.0) << name;
    EXPECT_EQ(result.evaluatedPixels, 0) << name;
  }
}

TEST(ShadowDefects, ColourProductsAreRefused) {
  const Image colour(2, 2, 4, 0.5F);
  for (const char* name : {"leaks", "acne", "contact_gap", "band_step", "discontinuity"})
    EXPECT_THROW(valueOf(name, colour, colour), Error) << name;
}

// A ramp in steps of 1/4 that repeats a value and then makes up for it in one step of 1/2.
TEST(BandStep, IsTheLargestStepLessTheReferences) {
  const Image reference = makeImage(5, 1, 1, {0.0F, 0.25F, 0.5F, 0.75F, 1.0F});
  const Image banded = makeImage(5, 1, 1, {0.0F, 0.25F, 0.25F, 0.75F, 1.0F});
  EXPECT_DOUBLE_EQ(valueOf("band_step", banded, reference), 0.25);
  EXPECT_DOUBLE_EQ(valueOf("band_step", reference, reference), 0.0);
  const Image flat(5, 1, 1, 0.5F);
  EXPECT_DOUBLE_EQ(valueOf("band_step", flat, reference), -0.25);
}

TEST(BandStep, SeesColumnsAsWellAsRows) {
  const Image reference(1, 3, 1, 0.5F), test = makeImage(1, 3, 1, {0.5F, 0.5F, 0.75F});
  EXPECT_DOUBLE_EQ(valueOf("band_step", test, reference), 0.25);
}

// The hard edge beside the penumbra hides the band from the whole image but not from the penumbra.
TEST(BandStep, PenumbraRegionLeavesHardEdgesOut) {
  const Image reference = makeImage(5, 1, 1, {0.0F, 1.0F, 0.75F, 0.75F, 0.625F});
  const Image test = makeImage(5, 1, 1, {0.0F, 1.0F, 0.75F, 0.25F, 0.625F});
  EXPECT_DOUBLE_EQ(valueOf("band_step", test, reference), 0.0);
  EXPECT_DOUBLE_EQ(valueOf("band_step", test, reference, {{"region", std::string("penumbra")}}), 0.5 - 0.125);
}

TEST(BandStep, StepsAcrossTheEdgeOfTheRegionDoNotCount) {
  const Image reference(3, 1, 1, 0.5F), test = makeImage(3, 1, 1, {0.5F, 0.5F, 0.0F});
  const Image mask = makeImage(3, 1, 1, {1.0F, 1.0F, 0.0F});
  EXPECT_DOUBLE_EQ(measure("band_step", pairOf(test, reference, &mask)).value, 0.0);
}

// Errors 0, 1/8, 1/8, -1/4, -1/4 along a ramp whose own steps of 1/4 do not count: changes 1/8, 0, 3/8, 0.
TEST(Discontinuity, IsTheChangeOfTheErrorBetweenNeighbours) {
  const Image reference = makeImage(5, 1, 1, {0.0F, 0.25F, 0.5F, 0.75F, 1.0F});
  const Image test = makeImage(5, 1, 1, {0.0F, 0.375F, 0.625F, 0.5F, 0.75F});
  const MetricResult result = measure("discontinuity", pairOf(test, reference));
  EXPECT_DOUBLE_EQ(result.value, 0.375);
  const std::vector<float> map = {0.125F, 0.125F, 0.375F, 0.375F, 0.0F};
  EXPECT_EQ(result.map->data, map);
  // Three of four changes are at most 1/8, two are 0.
  EXPECT_DOUBLE_EQ(valueOf("discontinuity", test, reference, {{"share", 0.75}}), 0.125);
  EXPECT_DOUBLE_EQ(valueOf("discontinuity", test, reference, {{"share", 0.5}}), 0.0);
}

// Band_step takes both figures from wherever they are largest, so that a large step of the reference hides a
// discontinuity elsewhere; discontinuity compares pair by pair, down columns too, and leaves out what has no
// receiver.
TEST(Discontinuity, IsEvaluatedPairByPair) {
  const Image reference = makeImage(2, 3, 1, {0.0F, 1.0F, 0.0F, 1.0F, 0.0F, 1.0F});
  const Image test = makeImage(2, 3, 1, {0.0F, 1.0F, 0.25F, 1.0F, 0.25F, 1.0F});
  EXPECT_DOUBLE_EQ(valueOf("discontinuity", test, reference), 0.25);
  EXPECT_DOUBLE_EQ(valueOf("band_step", test, reference), 0.0);
  const Image mask = makeImage(2, 3, 1, {1, 1, 0, 0, 1, 1});
  // The pair in the last row is left with its own change.
  EXPECT_DOUBLE_EQ(measure("discontinuity", pairOf(test, reference, &mask)).value, 0.25);
  const Image top = makeImage(2, 3, 1, {1, 1, 0, 0, 0, 0});
  EXPECT_DOUBLE_EQ(measure("discontinuity", pairOf(test, reference, &top)).value, 0.0);
}

}  // namespace
}  // namespace limen::perception
