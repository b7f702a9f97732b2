// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "perception/popping/predictor.h"
#include "perception/vision/castle_csf.h"
#include "perception/vision/masking.h"
#include "tests/perception/popping_images.h"

namespace limen::perception {
namespace {

// A grating whose contrast is 1 / S must have the difference that one JND has after masking, T(1), within 1.5
// dB: whatever its frequency, orientation, speed and luminance. None of the frequencies, luminances and
// speeds below is one at which the predictor's weights are fitted, and those are fitted along an axis. S is
// castleCSF's for the predictor's area, evaluated here.
struct Grating {
  double cpd, orientationDeg = 0.0, velocityDegS = 0.15, luminanceCdM2 = 100.0;
};

DisplayProfile displayOf(double pixelsPerDegree) {
  DisplayProfile display = studyDisplay();
  display.blackCdM2 = 0.0;
  display.peakCdM2 = 500.0;
  display.distanceM *= pixelsPerDegree / display.pixelsPerDegree();
  return display;
}

double sensitivityOf(const Grating& g, double areaDeg2) {
  return csfCastleAchromatic(g.cpd, g.cpd * g.velocityDegS, g.luminanceCdM2, areaDeg2);
}

PoppingSettings evenSettings() {
  PoppingSettings settings;
  settings.bands.weights = FittedWeights{};
  settings.bands.levels = LevelsByPeak{0.25};
  return settings;
}

/// 20 lg of the largest difference over T(1), away from the border.
double excessDb(const Grating& g, const DisplayProfile& display, PoppingSettings settings = evenSettings()) {
  constexpr int kSide = 448, kBorder = 112;
  settings.eyeMovement = NoTracking{};
  const double ppd = display.pixelsPerDegree(), contrast = 1.0 / sensitivityOf(g, 7.07);
  const double angle = g.orientationDeg * std::numbers::pi / 180.0;
  const double perPx = 2.0 * std::numbers::pi * g.cpd / ppd, mean = g.luminanceCdM2 / display.peakCdM2;
  const int height = g.orientationDeg == 0.0 ? 256 : kSide, top = g.orientationDeg == 0.0 ? 100 : kBorder;
  Image picture(kSide, height, 1), flat(kSide, height, 1, static_cast<float>(mean)), moves(kSide, height, 2);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < kSide; ++x) {
      const double phase =
          perPx * ((x - 0.5 * kSide) * std::cos(angle) + (y - 0.5 * height) * std::sin(angle));
      picture.at(x, y) = static_cast<float>(mean * (1.0 + contrast * std::cos(phase)));
      moves.at(x, y, 0) = static_cast<float>(g.velocityDegS * ppd / display.refreshHz);
    }
  PoppingInput in = linearPair(picture, flat);
  in.actualDisplacement = moves;
  const PoppingResult result = predictPopping(in, display, settings);
  double largest = 0.0;
  for (int y = top; y < height - top; ++y)
    for (int x = kBorder; x < kSide - kBorder; ++x)
      largest = std::max(largest, result.jndExact[static_cast<size_t>(y) * kSide + x]);
  return 20.0 * std::log10(largest / transducerSchwarz(1.0));
}

void expectEven(const Grating& g, const DisplayProfile& display) {
  EXPECT_NEAR(excessDb(g, display), 0.0, 1.5)
      << g.cpd << " cpd, " << g.orientationDeg << " deg, " << g.velocityDegS << " deg/s, " << g.luminanceCdM2
      << " cd/m2, S " << sensitivityOf(g, 7.07) << ", " << display.pixelsPerDegree() << " px/deg";
}

TEST(PoppingEvenness, GratingsAtRest) {
  for (const double ppd : {41.2, 60.0})
    for (double cpd = 0.31; cpd < std::min(25.0, 0.49 * ppd); cpd *= 1.43) expectEven({cpd}, displayOf(ppd));
}

TEST(PoppingEvenness, OtherLuminances) {
  for (const double luminance : {11.0, 310.0})
    for (const double cpd : {0.36, 1.27, 3.4, 8.3, 17.0})
      expectEven({cpd, 0.0, 0.15, luminance}, displayOf(41.2));
}

TEST(PoppingEvenness, OtherOrientations) {
  for (const double orientation : {33.0, 45.0, 90.0})
    for (const double cpd : {0.41, 1.15, 3.1, 6.9, 13.0}) expectEven({cpd, orientation}, displayOf(41.2));
}

TEST(PoppingEvenness, MovingGratings) {
  // Above some 2 deg/s on the retina sensitivity falls by more than 20 dB an octave, which the bands cannot
  // follow.
  for (const double velocity : {0.43, 1.07})
    for (double cpd = 0.33; cpd < 20.0; cpd *= 1.47) {
      const Grating g{cpd, 0.0, velocity};
      if (sensitivityOf(g, 7.07) > 2.0) expectEven(g, displayOf(41.2));
    }
}

// The default's weights, for comparison.
TEST(PoppingEvenness, OneWeightPerLevelIsNotEven) {
  PoppingSettings settings = evenSettings();
  settings.bands.weights = PeakWeights{};
  EXPECT_LT(excessDb({13.0}, displayOf(41.2), settings), -1.5);
}

}  // namespace
}  // namespace limen::perception
