// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "perception/popping/predictor.h"
#include "tests/perception/popping_images.h"

namespace limen::perception {
namespace {

PoppingSettings maskedSettings(const ExtendedMasking& masking = {}) {
  PoppingSettings settings;
  settings.neighbourhood = masking;
  return settings;
}

/// The published sum over a square without its centre, term by term.
double elevationByDefinition(const Image& contrasts, int channel, int x, int y, const ExtendedMasking& m) {
  double sum = 0.0;
  int count = 0;
  for (int dy = -m.radiusPx; dy <= m.radiusPx; ++dy)
    for (int dx = -m.radiusPx; dx <= m.radiusPx; ++dx) {
      if (dx == 0 && dy == 0) continue;
      const int nx = std::max(0, std::min(contrasts.width - 1, x + dx)),
                ny = std::max(0, std::min(contrasts.height - 1, y + dy));
      const double value = std::abs(double{contrasts.at(nx, ny, channel)});
      sum += std::max(0.0, std::pow(value, m.exponent) - std::pow(m.deadZone, m.exponent));
      ++count;
    }
  return 1.0 + m.strength * sum / count;
}

TEST(PoppingNeighbourhood, ResponsesAreThePublishedForm) {
  // Contrasts over thresholds are the responses without any masking; JPEG 2000's numerator is |x|^0.7.
  PoppingInput in = linearPair(sceneImage(75, 52, 0.45), noiseImage(75, 52, 3, 3, 0.2, 0.6));
  const ExtendedMasking kMaskings[] = {{.radiusPx = 1, .exponent = 0.2, .strength = 1.0, .deadZone = 0.0},
                                       {.radiusPx = 2, .exponent = 0.2, .strength = 1.0, .deadZone = 1.0},
                                       {.radiusPx = 6, .exponent = 1.5, .strength = 0.3, .deadZone = 2.0}};
  PoppingOptions options;
  for (const int level : {0, 1, 2})
    for (const char* frame : {"actual_", "predicted_"})
      options.stages.push_back("response_" + (frame + std::to_string(level)));
  PoppingSettings settings;
  settings.masking = {"none", {}};
  const PoppingResult plain = predictPopping(in, studyDisplay(), settings, options);
  settings.masking = {"self", {}};
  for (const ExtendedMasking& masking : kMaskings) {
    settings.neighbourhood = masking;
    const PoppingResult masked = predictPopping(in, studyDisplay(), settings, options);
    for (const std::string& name : options.stages) {
      const Image &contrasts = plain.stages.at(name), &responses = masked.stages.at(name);
      int bad = 0;
      for (int y = 0; y < contrasts.height; ++y)
        for (int x = 0; x < contrasts.width; ++x)
          for (int c = 0; c < 3; ++c) {
            const double value = contrasts.at(x, y, c);
            const double expected = std::copysign(std::pow(std::abs(value), 0.7), value) /
                                    elevationByDefinition(contrasts, c, x, y, masking);
            // Stages are stored in single precision.
            bad += !(std::abs(responses.at(x, y, c) - expected) <= 1e-5 * std::abs(expected) + 1e-9);
          }
      EXPECT_EQ(bad, 0) << name << " radius " << masking.radiusPx;
    }
  }
}

/// A patch of grating on grey, in a display's light.
struct Patch {
  double x, contrast, y = 0.0;  // from the middle row
};
constexpr int kPictureWidth = 320, kPictureHeight = 64;
constexpr double kTargetX = 80.0, kCyclesPerPx = 0.14;  // the peak of level 1
Image patches(const std::vector<Patch>& all) {
  Image image(kPictureWidth, kPictureHeight, 1);
  for (int y = 0; y < kPictureHeight; ++y)
    for (int x = 0; x < kPictureWidth; ++x) {
      double contrast = 0.0;
      for (const Patch& patch : all) {
        const double dx = x - patch.x, dy = y - 0.5 * kPictureHeight - patch.y, r = std::hypot(dx, dy) / 6.0;
        if (r >= 1.0) continue;
        const double window = 0.5 + 0.5 * std::cos(std::numbers::pi * r);
        contrast += patch.contrast * window * std::cos(2.0 * std::numbers::pi * kCyclesPerPx * dx);
      }
      image.at(x, y) = static_cast<float>(0.4 * (1.0 + contrast));
    }
  return image;
}

/// Contrast at which the largest difference that a patch makes within itself is 1 JND. With a speed, it
/// appears while all of the picture moves over the retina.
double thresholdOf(const std::vector<Patch>& maskers, PoppingSettings settings, double switchDegS = -1.0) {
  // Three bands, so that filters reach no further than some 70 px.
  settings.bands.levels = LevelCount{5};
  settings.adaptation = FixedAdaptation{100.0};
  settings.eyeMovement = NoTracking{};
  const DisplayProfile display = studyDisplay();
  const float perFrame =
      static_cast<float>(std::max(switchDegS, 0.15) * display.pixelsPerDegree() / display.refreshHz);
  Image moves(kPictureWidth, kPictureHeight, 2);
  for (size_t p = 0; p < moves.pixels(); ++p) moves.data[2 * p] = perFrame;
  const Image without = patches(maskers);
  double low = 1e-3, high = 0.5;
  for (int step = 0; step < 10; ++step) {
    const double contrast = std::sqrt(low * high);
    std::vector<Patch> all = maskers;
    all.push_back({kTargetX, contrast});
    PoppingInput in = linearPair(patches(all), without);
    in.actualDisplacement = moves;
    in.isSwitch = switchDegS >= 0.0;
    const PoppingResult result = predictPopping(in, display, settings);
    double largest = 0.0;
    for (int y = kPictureHeight / 2 - 6; y <= kPictureHeight / 2 + 6; ++y)
      for (int x = static_cast<int>(kTargetX) - 6; x <= kTargetX + 6; ++x)
        largest = std::max(largest, result.jndExact[static_cast<size_t>(y) * kPictureWidth + x]);
    (largest > 1.0 ? high : low) = contrast;
  }
  return std::sqrt(low * high);
}

const std::vector<Patch> kBeside = {{kTargetX - 13.0, 0.9},
                                    {kTargetX + 13.0, 0.9},
                                    {kTargetX, 0.9, -13.0},
                                    {kTargetX, 0.9, 13.0}},
                         kFar = {{280.0, 0.9}};

TEST(PoppingNeighbourhood, WhatIsBesideMasksAndWhatIsFarDoesNot) {
  // 1.5 deg/s make the patches flicker with 9 Hz, to which both the sustained and the transient mechanism
  // respond.
  for (const double switchDegS : {-1.0, 1.5}) {
    SCOPED_TRACE(switchDegS < 0.0 ? "lasting pictures" : "switch over time");
    const PoppingSettings masked = maskedSettings({.radiusPx = 6}), pointwise;
    const double alone = thresholdOf({}, masked, switchDegS),
                 nearby = thresholdOf(kBeside, masked, switchDegS),
                 alonePointwise = thresholdOf({}, pointwise, switchDegS);
    EXPECT_EQ(thresholdOf(kFar, masked, switchDegS), alone);
    EXPECT_GT(nearby, 1.2 * alone);
    EXPECT_GT(nearby / alone, 1.1 * thresholdOf(kBeside, pointwise, switchDegS) / alonePointwise);
    // A contrast at threshold is within the dead zone: alone it is seen as without neighbours.
    EXPECT_NEAR(alone, alonePointwise, 0.02 * alone);
  }
}

TEST(PoppingNeighbourhood, FartherReachMasksMoreOfTheDistance) {
  const std::vector<Patch> apart = {{kTargetX - 17.0, 0.9}, {kTargetX + 17.0, 0.9}};
  EXPECT_GT(thresholdOf(apart, maskedSettings({.radiusPx = 6})),
            1.05 * thresholdOf(apart, maskedSettings({.radiusPx = 1})));
}

TEST(PoppingNeighbourhood, NoStrengthIsPointWise) {
  PoppingInput in = linearPair(sceneImage(64, 48, 0.4), sceneImage(64, 48, 0.45));
  for (const bool isSwitch : {false, true}) {
    in.isSwitch = isSwitch;
    const PoppingResult plain = predictPopping(in, studyDisplay(), {}),
                        masked = predictPopping(in, studyDisplay(), maskedSettings({.strength = 0.0})),
                        strong = predictPopping(in, studyDisplay(), maskedSettings());
    for (size_t p = 0; p < plain.jndExact.size(); ++p)
      ASSERT_NEAR(masked.jndExact[p], plain.jndExact[p], 1e-12 * std::max(1.0, plain.jndExact[p]));
    EXPECT_LT(strong.summary.meanJnd, plain.summary.meanJnd);
  }
}

TEST(PoppingNeighbourhood, StackHasTheSameReachAsThePyramid) {
  PoppingSettings settings = maskedSettings({.radiusPx = 3});
  const PoppingInput in = linearPair(sceneImage(96, 80, 0.45), sceneImage(96, 80, 0.5));
  const double pyramid = predictPopping(in, studyDisplay(), settings).summary.meanJnd;
  settings.bands.decomposition = StackBands{};
  EXPECT_NEAR(predictPopping(in, studyDisplay(), settings).summary.meanJnd, pyramid, 0.15 * pyramid);
}

TEST(PoppingNeighbourhood, HardCasesStayFinite) {
  DisplayProfile lightless = studyDisplay();
  lightless.blackCdM2 = 0.0;
  for (const double zone : {0.0, 1.0})
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 40}, {4, 4}, {33, 5}, {40, 30}}) {
      const Image dark(width, height, 3);
      Image dot = dark, bright(width, height, 3, 5000.0F);
      dot.at(width / 2, height / 2, 1) = 1.0F;
      for (const Image& other : {dark, dot, bright})
        for (const bool isSwitch : {false, true}) {
          PoppingInput in = linearPair(dark, other);
          in.isSwitch = isSwitch;
          const PoppingResult result =
              predictPopping(in, lightless, maskedSettings({.radiusPx = 6, .deadZone = zone}));
          for (const double value : result.jndExact) ASSERT_TRUE(std::isfinite(value));
        }
      EXPECT_EQ(predictPopping(linearPair(dot, dot), lightless, maskedSettings()).summary.largestJnd, 0.0);
    }
}

}  // namespace
}  // namespace limen::perception
