// SPDX-License-Identifier: BSD-3-Clause
// The popping predictor over time: filters against closed forms and integrals of the published responses, the
// predictor against products of its parts.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "perception/popping/temporal_sensitivity.h"
#include "tests/perception/popping_images.h"

namespace limen::perception {
namespace {

constexpr double kPi = std::numbers::pi, kWindow = 0.5;

/// Step response at `timeS` after the step, from the response over frequency alone: the inverse Fourier
/// transform of R(f) times that of a step, R(0) / 2 + integral of R(f) sin(2 pi f t) / (pi f).
double stepResponse(CastleMechanism mechanism, double luminance, double timeS) {
  double sum = 0.0;
  const double step = 0.005;
  for (int i = 0; i < 100000; ++i) {
    const double hz = (i + 0.5) * step;
    sum += castleTemporal(mechanism, hz, luminance) * std::sin(2.0 * kPi * hz * timeS) / (kPi * hz) * step;
  }
  return 0.5 * castleTemporal(mechanism, 0.0, luminance) + sum;
}

double largestOf(const std::vector<double>& values) {
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

TEST(TemporalFilter, RespondsAsPublishedAtItsFrequencies) {
  for (const double refresh : {24.0, 60.0, 120.0, 240.0})
    for (const CastleMechanism mechanism : kAllTemporalMechanisms) {
      const TemporalFilter filter(mechanism, 30.0, refresh, kWindow);
      const std::vector<double>& taps = filter.taps();
      EXPECT_GE(filter.rateHz(), kLeastTemporalRateHz);
      EXPECT_DOUBLE_EQ(filter.rateHz(), refresh * filter.samplesPerFrame());
      const auto count = static_cast<double>(taps.size());
      for (const int k : {0, 1, 2, 5, 11, 30}) {
        double response = 0.0;
        for (size_t n = 0; n < taps.size(); ++n)
          response +=
              taps[n] * std::cos(2.0 * kPi * k * (static_cast<double>(n) - (count - 1.0) / 2.0) / count);
        EXPECT_NEAR(response, castleTemporal(mechanism, k * filter.rateHz() / count, 30.0), 1e-12)
            << toText(mechanism) << " " << k << " " << refresh;
      }
    }
}

TEST(TemporalFilter, AStepLastsInSustainedMechanismsAndPassesInTheTransientOne) {
  constexpr double kRefresh = 120.0;
  std::vector<double> frames(120, 0.0);
  std::fill(frames.begin() + 60, frames.end(), 1.0);
  for (const CastleMechanism mechanism : kAllTemporalMechanisms) {
    const TemporalFilter filter(mechanism, 100.0, kRefresh, kWindow);
    const std::vector<double> response = filter.respond(frames);
    const int perFrame = filter.samplesPerFrame();
    const double atRest = castleTemporal(mechanism, 0.0, 100.0);
    // Outside the window the response is that to what stays.
    EXPECT_NEAR(response[static_cast<size_t>(20 * perFrame)], 0.0, 1e-12);
    EXPECT_NEAR(response[static_cast<size_t>(100 * perFrame)], atRest, 1e-12);
    // The step lies half a sample before the first sample of its frame.
    for (const int frame : {48, 54, 57, 59, 60, 61, 63, 66, 72}) {
      const double timeS = (frame - 60 + 0.5 / perFrame) / kRefresh;
      EXPECT_NEAR(response[static_cast<size_t>(frame * perFrame)], stepResponse(mechanism, 100.0, timeS),
                  0.012)
          << toText(mechanism) << " " << timeS;
    }
    if (mechanism == CastleMechanism::Transient) {
      EXPECT_LT(atRest, 1e-6);
      EXPECT_GT(largestOf(response), 0.3);
      EXPECT_LT(largestOf(response), 0.5);
    } else {
      EXPECT_NEAR(largestOf(response), 1.0, 0.02);
    }
    EXPECT_NEAR(filter.onset(0.0), largestOf(response), 1e-12);
  }
}

TEST(TemporalFilter, FlickerAndStaticSignalsKeepTheirPublishedShare) {
  // A display as fast as the samples shows sines as they are.
  constexpr double kRefresh = 240.0;
  for (const CastleMechanism mechanism : kAllTemporalMechanisms)
    for (const double luminance : {1.0, 100.0}) {
      const TemporalFilter filter(mechanism, luminance, kRefresh, 1.0);
      for (const double hz : {2.0, 4.0, 8.0, 16.0, 30.0}) {
        std::vector<double> frames;
        for (int i = 0; i < 960; ++i) frames.push_back(std::cos(2.0 * kPi * hz * i / kRefresh));
        const std::vector<double> response = filter.respond(frames);
        double inPhase = 0.0;
        for (size_t i = 240; i < 720; ++i) inPhase += response[i] * frames[i] / 240.0;
        EXPECT_NEAR(inPhase, castleTemporal(mechanism, hz, luminance), 0.003)
            << toText(mechanism) << " " << hz << " Hz";
      }
      for (const double value : filter.respond(std::vector<double>(9, 0.7)))
        EXPECT_NEAR(value, 0.7 * castleTemporal(mechanism, 0.0, luminance), 1e-12);
    }
}

TEST(TemporalFilter, WhatAppearsIsSeenAtLeastAsWellAsWhatStays) {
  for (const CastleMechanism mechanism : kAllTemporalMechanisms) {
    const OnsetTable table(mechanism, 60.0, kWindow);
    for (const double luminance : {0.5, 7.0, 180.0}) {
      const TemporalFilter filter(mechanism, luminance, 60.0, kWindow);
      for (const double hz : {0.0, 0.003, 0.13, 0.9, 3.3, 11.0, 47.0, 119.0}) {
        EXPECT_GT(filter.onset(hz), castleTemporal(mechanism, hz, luminance) - 0.03);
        EXPECT_NEAR(table(hz, luminance), filter.onset(hz), 3e-3) << toText(mechanism) << " " << hz;
      }
      EXPECT_EQ(table(-3.0, luminance), table(3.0, luminance));
      EXPECT_EQ(table(500.0, luminance), castleTemporal(mechanism, 500.0, luminance));
    }
  }
}

TEST(TemporalFilter, OnsetsAreTabulatedOverTheKink) {
  const OnsetTable table(CastleMechanism::Transient, 60.0, kWindow);
  for (const double luminance :
       {0.0111, 0.01128, 0.0113, 0.0114, 0.0116, 0.012, 0.0125, 0.013, 0.014, 0.02, 0.05}) {
    const TemporalFilter filter(CastleMechanism::Transient, luminance, 60.0, kWindow);
    for (const double hz : {0.0, 0.02, 0.13, 0.9, 3.3, 11.0, 47.0})
      EXPECT_NEAR(table(hz, luminance), filter.onset(hz), 3e-3) << luminance << " cd/m2, " << hz << " Hz";
  }
}

TEST(HoldBlur, IsTheFourierTransformOfTheHoldAperture) {
  // A grating that the eye moves over while the display holds it, averaged over the time for which it is lit.
  for (const double share : {1.0, 0.5, 0.1})
    for (const double cpd : {0.5, 2.0, 8.0})
      for (const double speed : {0.0, 1.0, 5.0, 30.0}) {
        std::complex<double> sum = 0.0;
        constexpr int kSteps = 20000;
        for (int i = 0; i < kSteps; ++i)
          sum +=
              std::polar(1.0, 2.0 * kPi * cpd * speed * share / 60.0 * (i + 0.5) / kSteps) / double(kSteps);
        EXPECT_NEAR(holdBlur(cpd, speed, 60.0, share), std::abs(sum), 1e-6) << cpd << " " << speed;
      }
  EXPECT_EQ(holdBlur(4.0, 0.0, 60.0), 1.0);
  EXPECT_EQ(holdBlur(4.0, 30.0, 60.0, 0.0), 1.0);
  EXPECT_NEAR(holdBlur(4.0, 15.0, 60.0), 0.0, 1e-15);  // a period each frame
  EXPECT_EQ(holdBlur(4.0, INFINITY, 60.0), 0.0);
}

class SwitchTest : public testing::Test {
 protected:
  static Image grating(double cyclesPerPx, double contrast) {
    Image image(256, 64, 1);
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        image.at(x, y) = static_cast<float>(0.4 * (1.0 + contrast * std::sin(2.0 * kPi * cyclesPerPx * x)));
    return image;
  }
  static PoppingInput appearing(double cyclesPerPx, double contrast, double pxPerFrame) {
    PoppingInput in = linearPair(grating(cyclesPerPx, contrast), grating(cyclesPerPx, 0.0));
    in.isSwitch = true;
    in.actualDisplacement = Image(256, 64, 2);
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 256; ++x) in.actualDisplacement.at(x, y, 0) = static_cast<float>(pxPerFrame);
    return in;
  }
  static PoppingSettings adaptedTo100() {
    PoppingSettings settings;
    settings.adaptation = FixedAdaptation{100.0};
    return settings;
  }
  static double largest(const Image& image, int channel) {
    double value = 0.0;
    for (int y = 16; y < 48; ++y)
      for (int x = 64; x < 192; ++x)
        if (x < image.width && y < image.height)
          value = std::max(value, std::abs(double(image.at(x, y, channel))));
    return value;
  }
};

TEST_F(SwitchTest, AFaintGratingIsSeenByItsMechanismsSum) {
  // Far below threshold the transducer is the identity.
  const DisplayProfile display = studyDisplay();
  const PoppingSettings settings = adaptedTo100();
  const PoppingModel model = poppingModel(256, 64, display, settings);
  const Sensitivity sensitivity(model, display, settings, false);
  for (const double pxPerFrame : {0.0, 2.0, 8.0})
    for (const int level : {0, 1}) {
      const double cpd = model.peakCpd[size_t(level)];
      const PoppingResult result =
          predictPopping(appearing(0.1, 1e-4, pxPerFrame), display, settings, {false, {"all"}});
      const std::string at = "_" + std::to_string(level);
      const double contrast = largest(result.stages.at("contrast_actual" + at), 0);
      // Motion and eye: 60 Hz, tracked with a gain of 0.82.
      const double screen = pxPerFrame * 60.0 / display.pixelsPerDegree();
      const double retinal = std::max(0.15, 0.18 * screen - 0.15), eye = std::max(0.0, screen - retinal);
      double expected = 0.0, atDrift = 0.0;
      for (const CastleMechanism mechanism : {CastleMechanism::Sustained, CastleMechanism::Transient}) {
        const double spatial = castleSpatial(mechanism, cpd, 100.0, model.areaDeg2);
        expected += spatial * TemporalFilter(mechanism, 100.0, 60.0, kWindow).onset(cpd * retinal);
        atDrift += spatial * castleTemporal(mechanism, cpd * 0.15, 100.0);
      }
      const double blur =
          cpd * eye == 0.0 ? 1.0 : std::abs(std::sin(kPi * cpd * eye / 60.0) / (kPi * cpd * eye / 60.0));
      expected *= contrast * blur * sensitivity.at(level, 0.15, 100.0)[0] / atDrift;
      ASSERT_GT(expected, 0.0);
      EXPECT_NEAR(largest(result.stages.at("difference" + at), 0) / expected, 1.0, 6e-3)
          << pxPerFrame << " px " << level;
    }
}

TEST_F(SwitchTest, MotionBlursWhatTheEyeFollowsOnADisplayThatHolds) {
  const DisplayProfile display = studyDisplay();
  const PoppingSettings held = adaptedTo100();
  PoppingSettings flashed = held;
  std::get<TemporalChannels>(flashed.temporal).holdShare = 0.0;
  const auto jnd = [&](const PoppingSettings& settings, double pxPerFrame) {
    return predictPopping(appearing(0.25, 0.05, pxPerFrame), display, settings).summary.largestJnd;
  };
  EXPECT_EQ(jnd(held, 0.0), jnd(flashed, 0.0));
  EXPECT_LT(jnd(held, 2.0), jnd(flashed, 2.0));
  EXPECT_LT(jnd(held, 5.0), jnd(flashed, 5.0));
  // The slip on the retina alone costs fine detail sensitivity, too.
  EXPECT_LT(jnd(flashed, 20.0), jnd(flashed, 0.0));
}

TEST_F(SwitchTest, SteadyMotionMasksAChangeInTheTransientMechanism) {
  // The same change of a strong pattern: at rest nothing masks the transient mechanism.
  const auto identity = [](double c) { return c; };
  const auto compressive = [](double c) { return std::copysign(std::pow(std::abs(c), 0.7), c); };
  const TemporalGain none, steadyless{0.0, 0.4}, driven{0.9, 0.9};
  TemporalGains rest{none, steadyless, none, none}, moving{none, driven, none, none};
  const std::array<double, 3> actual{22.0, 0, 0}, predicted{20.0, 0, 0};
  EXPECT_NEAR(switchDifference(actual, rest, predicted, rest, 1.0, identity)[0], 0.8, 1e-12);
  EXPECT_NEAR(switchDifference(actual, moving, predicted, moving, 1.0, identity)[0], 1.8, 1e-12);
  EXPECT_GT(switchDifference(actual, rest, predicted, rest, 1.0, compressive)[0],
            switchDifference(actual, moving, predicted, moving, 1.0, compressive)[0]);
}

TEST_F(SwitchTest, EqualAndUniformContentIsNeverSeenToSwitch) {
  const DisplayProfile display = studyDisplay();
  PoppingInput same = linearPair(sceneImage(96, 72, 0.4), sceneImage(96, 72, 0.4));
  same.isSwitch = true;
  same.actualDisplacement = Image(96, 72, 2, 3.0F);
  EXPECT_EQ(predictPopping(same, display).summary.largestJnd, 0.0);
  PoppingInput flat = linearPair(uniformImage(96, 72, 3, 0.5F), uniformImage(96, 72, 3, 0.25F));
  flat.isSwitch = true;
  EXPECT_NEAR(predictPopping(flat, display).summary.largestJnd, 0.0, 1e-9);
}

TEST_F(SwitchTest, SwappingTheFramesFlipsTheSignAndRunsAreAlike) {
  const DisplayProfile display = studyDisplay();
  PoppingInput in = linearPair(sceneImage(96, 72, 0.4), sceneImage(96, 72, 0.44)), swapped = in;
  in.isSwitch = swapped.isSwitch = true;
  std::swap(swapped.actual, swapped.predicted);
  const PoppingResult first = predictPopping(in, display), again = predictPopping(in, display),
                      back = predictPopping(swapped, display);
  EXPECT_GT(first.summary.largestJnd, 1.0);
  EXPECT_EQ(first.jndExact, again.jndExact);
  for (size_t p = 0; p < first.jndExact.size(); ++p)
    ASSERT_NEAR(first.jndExact[p], back.jndExact[p], 1e-9 * (1.0 + first.jndExact[p]));
  EXPECT_NEAR(first.summary.signedMeanJnd, -back.summary.signedMeanJnd, 1e-9);
}

TEST_F(SwitchTest, LastingPicturesAndTheThesisLookAtOneFrame) {
  const DisplayProfile display = studyDisplay();
  PoppingInput in = linearPair(sceneImage(96, 72, 0.4), sceneImage(96, 72, 0.44));
  const PoppingResult lasting = predictPopping(in, display);
  in.isSwitch = true;
  PoppingSettings thesis;
  thesis.temporal = SingleFrame{};
  EXPECT_EQ(predictPopping(in, display, thesis).jndExact, lasting.jndExact);
  EXPECT_NE(predictPopping(in, display).jndExact, lasting.jndExact);
}

}  // namespace
}  // namespace limen::perception
