// SPDX-License-Identifier: BSD-3-Clause
#include "perception/metrics/error_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "metric_helpers.h"
#include "perception/vision/colour.h"

namespace limen::perception {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

double decode(double coded) {
  return coded <= 0.04045 ? coded / 12.92 : std::pow((coded + 0.055) / 1.055, 2.4);
}

std::vector<float> colourOf(float value, double scale) {
  return errorPicture(makeImage(1, 1, 1, {value}), scale).data;
}

double lightnessOf(float value) {
  const std::vector<float> c = colourOf(value, 1.0);
  return labFromLinearRgb({decode(c[0]), decode(c[1]), decode(c[2])}).lightness;
}

TEST(ErrorPicture, MatchesPublishedColoursOfMagma) {
  const struct {
    int index;
    float r, g, b;
  } kPublished[] = {{0, 0.001462F, 0.000466F, 0.013866F},   {8, 0.013708F, 0.011771F, 0.068667F},
                    {64, 0.316654F, 0.071690F, 0.485380F},  {128, 0.716387F, 0.214982F, 0.475290F},
                    {160, 0.904281F, 0.319610F, 0.388137F}, {216, 0.997325F, 0.711848F, 0.488154F},
                    {255, 0.987053F, 0.991438F, 0.749504F}};
  for (const auto& row : kPublished) {
    const std::vector<float> colour = colourOf(static_cast<float>(row.index) / 255.0F, 1.0);
    EXPECT_NEAR(colour[0], row.r, 0.012) << row.index;
    EXPECT_NEAR(colour[1], row.g, 0.012) << row.index;
    EXPECT_NEAR(colour[2], row.b, 0.012) << row.index;
  }
}

// Magma runs from L* = 0.2 to 98.4: 24 steps of about 4.1 each. It was made even in CAM02-UCS, whose
// lightness parts from L* near black, so below L* = 10 only the rise is asked for.
TEST(ErrorPicture, LightnessRisesEvenly) {
  for (int i = 0; i < 24; ++i) {
    const double below = lightnessOf(static_cast<float>(i) / 24.0F);
    const double step = lightnessOf(static_cast<float>(i + 1) / 24.0F) - below;
    EXPECT_GT(step, 1.0) << i;
    if (below > 10.0) {
      EXPECT_NEAR(step, 4.1, 1.4) << i;
    }
  }
}

TEST(ErrorPicture, ScaleIsTheBrightestColourAndMoreIsClamped) {
  EXPECT_EQ(colourOf(0.05F, 0.05), colourOf(1.0F, 1.0));
  EXPECT_EQ(colourOf(9.0F, 0.05), colourOf(1.0F, 1.0));
  EXPECT_EQ(colourOf(-1.0F, 1.0), colourOf(0.0F, 1.0));
  EXPECT_EQ(colourOf(0.2F, 0.0), colourOf(1.0F, 1.0));
}

TEST(ErrorPicture, NonFiniteValuesStandOut) {
  EXPECT_EQ(colourOf(kNan, 1.0), (std::vector<float>{0.0F, 1.0F, 0.0F}));
  EXPECT_EQ(colourOf(std::numeric_limits<float>::infinity(), 0.0), (std::vector<float>{0.0F, 1.0F, 0.0F}));
}

TEST(ErrorScale, IsARoundNumberThatHoldsEveryFiniteValue) {
  const struct {
    float largest;
    double scale;
  } kTable[] = {{0.03F, 0.05}, {0.2F, 0.2}, {0.21F, 0.5},  {1.0F, 1.0},   {0.9F, 1.0},
                {7.0F, 10.0},  {0.1F, 0.1}, {10.0F, 10.0}, {1e-6F, 1e-6}, {0.0F, 1.0}};
  for (const auto& row : kTable)
    EXPECT_NEAR(errorScale(makeImage(3, 1, 1, {0.0F, row.largest, kNan})), row.scale, 1e-9 * row.scale)
        << row.largest;
}

TEST(DisplayPicture, CodesClampsAndSpreadsGrey) {
  const Image grey = displayPicture(makeImage(4, 1, 1, {0.0F, 0.2140411F, 1.5F, kNan}));
  EXPECT_EQ(grey.channels, 3);
  for (int c = 0; c < 3; ++c) {
    EXPECT_EQ(grey.at(0, 0, c), 0.0F);
    EXPECT_NEAR(grey.at(1, 0, c), 0.5F, 1e-6);
    EXPECT_NEAR(grey.at(2, 0, c), 1.0F, 1e-6);
    EXPECT_EQ(grey.at(3, 0, c), c == 1 ? 1.0F : 0.0F);
  }
  const Image colour = displayPicture(makeImage(1, 1, 4, {0.2140411F, -1.0F, 1.0F, 0.3F}));
  EXPECT_NEAR(colour.at(0, 0, 0), 0.5F, 1e-6);
  EXPECT_EQ(colour.at(0, 0, 1), 0.0F);
  EXPECT_NEAR(colour.at(0, 0, 2), 1.0F, 1e-6);
}

}  // namespace
}  // namespace limen::perception
