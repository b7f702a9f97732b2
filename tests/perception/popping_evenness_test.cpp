// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

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

constexpr int kWidth = 256, kRows = 128;
constexpr double kFine = 0.03;  ///< cycles per pixel from which fewer rows are enough

bool isFine(const Grating& g, const DisplayProfile& display) {
  return g.cpd >= kFine * display.pixelsPerDegree();
}

/// 20 lg of the largest difference over T(1) in the middle of each grating. The gratings lie one below the
/// other and have the same speed and luminance; several share a picture only if they are fine and upright, so
/// that none reaches the middle of its neighbours.
/// With `screenDegS`, the eye follows pictures that move with this speed, and velocities of gratings are what
/// remains on the retina.
std::vector<double> excessDb(const std::vector<Grating>& gratings, const DisplayProfile& display,
                             PoppingSettings settings = evenSettings(), double screenDegS = 0.0) {
  if (screenDegS == 0.0) settings.eyeMovement = NoTracking{};
  const double ppd = display.pixelsPerDegree();
  const bool isTilted = gratings[0].orientationDeg != 0.0;
  const int rows = gratings.size() > 1                         ? kRows / 2
                   : isTilted && !isFine(gratings[0], display) ? 2 * kRows
                                                               : kRows;
  const int height = std::max(kRows, rows * static_cast<int>(gratings.size()));
  Image picture(kWidth, height, 1), flat(kWidth, height, 1), moves(kWidth, height, 2);
  for (int y = 0; y < height; ++y) {
    const Grating& g = gratings[std::min(static_cast<size_t>(y / rows), gratings.size() - 1)];
    const double contrast = 1.0 / sensitivityOf(g, 7.07), mean = g.luminanceCdM2 / display.peakCdM2;
    const double angle = g.orientationDeg * std::numbers::pi / 180.0;
    const double perPx = 2.0 * std::numbers::pi * g.cpd / ppd;
    for (int x = 0; x < kWidth; ++x) {
      const double phase =
          perPx * ((x - 0.5 * kWidth) * std::cos(angle) + (y - 0.5 * height) * std::sin(angle));
      picture.at(x, y) = static_cast<float>(mean * (1.0 + contrast * std::cos(phase)));
      flat.at(x, y) = static_cast<float>(mean);
      moves.at(x, y, 0) =
          static_cast<float>((screenDegS > 0.0 ? screenDegS : g.velocityDegS) * ppd / display.refreshHz);
    }
  }
  PoppingInput in = linearPair(picture, flat);
  in.actualDisplacement = moves;
  const PoppingResult result = predictPopping(in, display, settings);
  const int reach = isTilted ? 24 : 4;
  std::vector<double> out;
  for (size_t i = 0; i < gratings.size(); ++i) {
    const int middle = static_cast<int>(i) * rows + rows / 2;
    double largest = 0.0;
    for (int y = middle - reach; y < middle + reach; ++y)
      for (int x = kWidth / 2 - 32; x < kWidth / 2 + 32; ++x)
        largest = std::max(largest, result.jndExact[static_cast<size_t>(y) * kWidth + x]);
    out.push_back(20.0 * std::log10(largest / transducerSchwarz(1.0)));
  }
  return out;
}

/// Gratings of one speed and luminance.
void expectEven(const std::vector<Grating>& gratings, const DisplayProfile& display,
                double screenDegS = 0.0) {
  std::vector<std::vector<Grating>> pictures;
  std::vector<Grating> strips;
  for (const Grating& g : gratings)
    if (isFine(g, display) && g.orientationDeg == 0.0)
      strips.push_back(g);
    else
      pictures.push_back({g});
  if (!strips.empty()) pictures.push_back(strips);
  for (const std::vector<Grating>& picture : pictures) {
    const std::vector<double> excess = excessDb(picture, display, evenSettings(), screenDegS);
    for (size_t i = 0; i < picture.size(); ++i) {
      const Grating& g = picture[i];
      EXPECT_NEAR(excess[i], 0.0, 1.5)
          << g.cpd << " cpd, " << g.orientationDeg << " deg, " << g.velocityDegS << " deg/s, "
          << g.luminanceCdM2 << " cd/m2, S " << sensitivityOf(g, 7.07) << ", " << display.pixelsPerDegree()
          << " px/deg";
    }
  }
}

TEST(PoppingEvenness, GratingsAtRest) {
  for (const double ppd : {41.2, 60.0}) {
    std::vector<Grating> gratings;
    for (double cpd = 0.31; cpd < std::min(25.0, 0.49 * ppd); cpd *= 1.43) gratings.push_back({cpd});
    expectEven(gratings, displayOf(ppd));
  }
}

TEST(PoppingEvenness, OtherLuminances) {
  for (const double luminance : {11.0, 310.0}) {
    std::vector<Grating> gratings;
    for (const double cpd : {0.36, 1.27, 3.4, 8.3, 17.0}) gratings.push_back({cpd, 0.0, 0.15, luminance});
    expectEven(gratings, displayOf(41.2));
  }
}

TEST(PoppingEvenness, OtherOrientations) {
  for (const double cpd : {0.41, 3.1, 13.0}) expectEven({{cpd, 33.0}, {cpd, 90.0}}, displayOf(41.2));
  for (const double cpd : {0.41, 1.15, 3.1, 6.9, 13.0}) expectEven({{cpd, 45.0}}, displayOf(41.2));
}

/// Gratings that need a contrast of up to an eighth. Below, sensitivity at higher speeds falls with more than
/// 20 dB an octave, which no sum of such bands follows.
std::vector<Grating> visibleGratings(double highestCpd, double retinalDegS, double luminanceCdM2) {
  std::vector<Grating> gratings;
  for (double cpd = 0.37; cpd < highestCpd; cpd *= 1.27) {
    const Grating g{cpd, 0.0, retinalDegS, luminanceCdM2};
    if (sensitivityOf(g, 7.07) >= 8.0) gratings.push_back(g);
  }
  return gratings;
}

TEST(PoppingEvenness, GratingsMovingOverTheRetina) {
  for (const double velocity : {0.43, 1.07, 2.7, 5.3, 8.7, 15.7})
    expectEven(visibleGratings(20.0, velocity, 100.0), displayOf(41.2));
  for (const double velocity : {3.9, 14.3})
    expectEven(visibleGratings(25.0, velocity, 100.0), displayOf(60.0));
}

TEST(PoppingEvenness, MovingGratingsOfOtherLuminances) {
  for (const double luminance : {11.0, 310.0})
    for (const double velocity : {2.2, 6.1, 12.3})
      expectEven(visibleGratings(20.0, velocity, luminance), displayOf(41.2));
}

TEST(PoppingEvenness, GratingsMovingOverTheScreenThatTheEyeFollows) {
  // The eye follows 0.82 of a speed and 0.15 deg/s more, and drifts with at least 0.15 deg/s.
  for (const double screen : {3.1, 8.2, 16.0})
    expectEven(visibleGratings(20.0, std::max(0.15, screen - (0.82 * screen + 0.15)), 100.0), displayOf(41.2),
               screen);
}

// The default's weights, for comparison.
TEST(PoppingEvenness, OneWeightPerLevelIsNotEven) {
  PoppingSettings settings = evenSettings();
  settings.bands.weights = PeakWeights{};
  EXPECT_LT(excessDb({{13.0}}, displayOf(41.2), settings)[0], -1.5);
}

// A switch over time sees what the fitted parts add up to, as lasting pictures do: what fitting changes at a
// frequency is the same for both. Near the threshold responses are as contrasts are.
TEST(PoppingEvenness, SwitchesUseFittedWeights) {
  const DisplayProfile display = displayOf(41.2);
  PoppingSettings fitted = evenSettings(), peak = evenSettings();
  peak.bands.weights = PeakWeights{};
  for (PoppingSettings* settings : {&fitted, &peak}) settings->masking = {"none", {}};
  for (const double cpd : {5.8, 9.3, 13.0}) {
    const auto largest = [&](const PoppingSettings& settings, bool isSwitch) {
      Image flat(256, 128, 1, 0.2F), picture = flat;
      for (int y = 0; y < flat.height; ++y)
        for (int x = 0; x < flat.width; ++x)
          picture.at(x, y) += static_cast<float>(
              0.002 * std::cos(2.0 * std::numbers::pi * cpd / display.pixelsPerDegree() * x));
      PoppingInput in = linearPair(picture, flat);
      in.isSwitch = isSwitch;
      const PoppingResult result = predictPopping(in, display, settings);
      double value = 0.0;
      for (int x = 96; x < 160; ++x) value = std::max(value, result.jndExact[size_t{64} * 256 + x]);
      return value;
    };
    const double lasting = largest(fitted, false) / largest(peak, false);
    EXPECT_NEAR(largest(fitted, true) / largest(peak, true), lasting, 0.1 * lasting) << cpd << " cpd";
  }
}

}  // namespace
}  // namespace limen::perception
