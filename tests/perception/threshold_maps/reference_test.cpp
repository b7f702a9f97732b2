// SPDX-License-Identifier: BSD-3-Clause
#include "perception/threshold_maps/reference.h"

#include <gtest/gtest.h>

#include "experiments/base/error.h"
#include "perception/threshold_maps/model.h"
#include "perception/vision/castle_csf.h"
#include "perception/vision/csf_models.h"
#include "perception/vision/masking.h"
#include "perception/vision/tvi.h"
#include "tests/perception/threshold_maps/edge_support.h"
#include "tests/perception/threshold_maps/patterns.h"

namespace limen::perception {
namespace {

std::string text(const char* value) { return value; }

TEST(ThresholdMap, OfAFlatFieldIsAFifthOfTheTvi) {
  // tvi_W(100) = 10^(2 - 1.255) = 5.55904; S = 1.
  for (const char* decomposition : {"stack", "pyramid", "true_stack"})
    for (const char* rule : {"original", "actual", "none"})
      for (const char* flat : {"smooth", "exact"}) {
        const ThresholdMap map = computeThresholdMap(Plane(97, 64, 100.0), kStudyPpd,
                                                     settingsOf({{"decomposition", text(decomposition)},
                                                                 {"frequency_elevation", text(rule)},
                                                                 {"flat", text(flat)}}));
        // exact: what rounding leaves of the contrasts decides the elevation
        if (text(flat) == "exact") continue;
        for (const double value : map.thresholdCdM2.data)
          ASSERT_NEAR(value, 0.2 * std::pow(10.0, 0.745), 1e-9);
      }
  EXPECT_NEAR(computeThresholdMap(Plane(1, 1, 100.0), kStudyPpd, {}).thresholdCdM2.at(0, 0), 1.11181, 5e-6);
}

TEST(ThresholdMap, EqualsThePlainFormulaWorkedPixelByPixel) {
  // A second implementation for the original form: pyramid by the plain two-dimensional kernel, direct
  // bilinear sampling, equations (9.10) and (9.11) term by term; with the thesis's sensitivity and castleCSF.
  const int size = 64;
  const Plane image = picture(size, size);
  const std::map<std::string, ParameterValue> form = {{"decomposition", text("pyramid")},
                                                      {"frequency_elevation", text("original")},
                                                      {"flat", text("exact")},
                                                      {"adaptation", text("nearest_level")}};
  std::vector<std::vector<double>> levels = {image.data};
  const double w[6] = {1, 5, 10, 10, 5, 1};
  for (int n = size; n > 1; n /= 2) {
    const std::vector<double>& fine = levels.back();
    std::vector<double> coarse;
    for (int y = 0; y < n / 2; ++y)
      for (int x = 0; x < n / 2; ++x) {
        double sum = 0.0;
        for (int j = 0; j < 36; ++j) {
          const int sx = std::clamp(2 * x + j % 6 - 2, 0, n - 1),
                    sy = std::clamp(2 * y + j / 6 - 2, 0, n - 1);
          sum += w[j % 6] * w[j / 6] / 1024.0 * fine[static_cast<size_t>(sy * n + sx)];
        }
        coarse.push_back(sum);
      }
    levels.push_back(coarse);
  }
  const auto sample = [&](size_t level, int px, int py) {
    const int n = size >> level;
    const double x = (px + 0.5) / (1 << level) - 0.5, y = (py + 0.5) / (1 << level) - 0.5;
    const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
    const auto at = [&](int i, int j) {
      return levels[level][static_cast<size_t>(std::clamp(j, 0, n - 1) * n + std::clamp(i, 0, n - 1))];
    };
    const double u = x - x0, v = y - y0;
    return (1 - v) * ((1 - u) * at(x0, y0) + u * at(x0 + 1, y0)) +
           v * ((1 - u) * at(x0, y0 + 1) + u * at(x0 + 1, y0 + 1));
  };
  struct Model {
    ThresholdMapSettings settings;
    std::function<double(double, double)> csf;
    double peak;  ///< at 100 cd/m2
  };
  const auto castle = [](double cpd, double luminance) {
    return csfCastleAchromatic(cpd, 0.15 * cpd, luminance, 7.07);
  };
  double castlePeak = 0.0;
  for (double cpd = 0.1; cpd < 60.0; cpd *= 1.0003) castlePeak = std::max(castlePeak, castle(cpd, 100.0));
  const double f[5] = {20.535, 5.177, 2.459, 1.215, 0.606};  // cpd, six-tap column of the table
  for (const Model& model :
       {Model{thesisOf(form), [](double cpd, double luminance) { return csfBarten89(cpd, luminance); },
              525.2},
        Model{settingsOf(form), castle, castlePeak}}) {
    const ThresholdMap map = computeThresholdMap(image, kStudyPpd, model.settings);
    for (int y = 0; y < size; y += 7)
      for (int x = 0; x < size; x += 5) {
        const double adaptation = sample(5, x, y);
        double top = 0.0, bottom = 0.0;
        for (size_t i = 0; i < 5; ++i) {
          const double c = std::abs((sample(i, x, y) - sample(i + 1, x, y)) / sample(i + 2, x, y));
          const double F = f[i] < 4.0 ? 1.0 : model.peak / model.csf(f[i], 100.0);
          top += c * F * elevationDaly(c * model.csf(f[i], adaptation));
          bottom += c;
        }
        const double expected = 0.2 * tviWard(adaptation) * top / bottom;
        // Frequencies are given to four digits, the peak sensitivity too.
        EXPECT_NEAR(map.thresholdCdM2.at(x, y) / expected, 1.0, 1e-3)
            << model.settings.csf << " " << x << " " << y;
      }
  }
}

TEST(ThresholdMap, IsFiniteForEveryImageAndSetting) {
  std::map<std::string, Plane> images = adversarialPatterns();
  images["not finite"] = Plane(40, 30, std::nan(""));
  images["infinite"] = Plane(40, 30, HUGE_VAL);
  images["negative"] = Plane(40, 30, -5.0);
  const std::vector<std::map<std::string, ParameterValue>> variants = {
      {},
      {{"decomposition", text("pyramid")}, {"downsample", text("nine_fetch")}, {"levels", int64_t{9}}},
      {{"decomposition", text("true_stack")}, {"levels", int64_t{5}}},
      {{"decomposition.upsampler", text("expand")}, {"downsample", text("burt")}, {"border", text("mirror")}},
      {{"flat", text("exact")},
       {"frequency_elevation", text("original")},
       {"adaptation", text("level")},
       {"adaptation.level", int64_t{0}}},
      {{"masking", text("lubin")}, {"tvi", text("from_csf")}, {"csf", text("barten03")}},
      {{"masking", text("self")}, {"tvi", text("ward_smoothed")}, {"csf", text("daly98")}},
      {{"masking", text("none")}, {"csf", text("martin92")}, {"gain_compensation", true}},
      {{"decomposition", text("repeated")}, {"adaptation", text("mistaken_degree")}},
  };
  for (const auto& [name, image] : images)
    for (const auto& given : variants)
      for (const double ppd : {kStudyPpd, 0.5, 200.0}) {
        if (image.pixels() > 12000 && ppd != kStudyPpd) continue;
        const ThresholdMap map = computeThresholdMap(image, ppd, settingsOf(given));
        ASSERT_EQ(map.thresholdCdM2.pixels(), image.pixels());
        for (const double value : map.thresholdCdM2.data) {
          ASSERT_TRUE(std::isfinite(value)) << name;
          ASSERT_GE(value, 0.0) << name;
        }
      }
}

TEST(ThresholdMap, CountsContrastsThatHadToBeGuarded) {
  EXPECT_EQ(computeThresholdMap(Plane(64, 64, 0.0), kStudyPpd, {}).guarded, 5 * 64 * 64);
  EXPECT_EQ(computeThresholdMap(picture(64, 64), kStudyPpd, {}).guarded, 0);
}

TEST(ThresholdMap, RisesWithTheContrastOfAMasker) {
  // Gratings at band 1's peak about one mean: the threshold averaged over the field must never fall, and at
  // the highest contrast masking must have raised it clearly.
  double previous = 0.0, first = 0.0;
  for (const double contrast : {0.0, 0.01, 0.05, 0.1, 0.2, 0.4, 0.8}) {
    const Plane image = pattern(
        128, 128, [&](int x, int) { return 100.0 * (1.0 + contrast * std::cos(2.0 * M_PI * 0.12605 * x)); });
    const ThresholdMap map = computeThresholdMap(image, kStudyPpd, {});
    double mean = 0.0;
    for (int y = 32; y < 96; ++y)
      for (int x = 32; x < 96; ++x) mean += map.thresholdCdM2.at(x, y) / 4096.0;
    if (contrast == 0.0) first = mean;
    EXPECT_GE(mean, previous * (1.0 - 1e-9)) << contrast;
    previous = mean;
  }
  // c_1 has a peak of 0.554 x 0.8; T_D of 0.44 times about 477 is some 42.
  EXPECT_GT(previous, 10.0 * first);
}

TEST(ThresholdMap, DependsOnPixelsPerDegreeAlone) {
  // Half the pitch at half the distance, and the double of both: one viewing angle, one map.
  DisplayProfile display = displayPreset("schwarz_2009"), farther = display;
  farther.distanceM *= 2.0;
  farther.widthM *= 2.0;
  farther.heightM *= 2.0;
  const Plane image = picture(96, 64);
  const Plane near = computeThresholdMap(image, display.pixelsPerDegree(), {}).thresholdCdM2;
  const Plane far = computeThresholdMap(image, farther.pixelsPerDegree(), {}).thresholdCdM2;
  for (size_t i = 0; i < near.data.size(); ++i) EXPECT_NEAR(near.data[i] / far.data[i], 1.0, 1e-9);
}

TEST(ThresholdMap, OfAnImageAtTwiceTheDistanceIsThatOfTheImageShrunk) {
  // From twice as far the same pixels subtend half the angle: band i + 1 near is band i far, up to what the
  // finest band holds. A grating coarse enough to have no part in band 0.
  const auto grating = [](int size, double wavelengthPx) {
    return pattern(size, size,
                   [&](int x, int) { return 60.0 + 40.0 * std::cos(2.0 * M_PI * x / wavelengthPx); });
  };
  const auto mean = [](const ThresholdMap& map) {
    const int w = map.thresholdCdM2.width;
    double sum = 0.0;
    for (int y = w / 4; y < w * 3 / 4; ++y)
      for (int x = w / 4; x < w * 3 / 4; ++x) sum += map.thresholdCdM2.at(x, y);
    return sum / (0.25 * w * w);
  };
  // Without F, which at 41 cpd magnifies what little of the grating the finest band holds.
  const auto ratio = [&](const char* decomposition) {
    const auto settings = [&](int64_t levels) {
      return settingsOf({{"decomposition", text(decomposition)},
                         {"levels", levels},
                         {"frequency_elevation", text("none")}});
    };
    return mean(computeThresholdMap(grating(512, 64.0), 2 * kStudyPpd, settings(8))) /
           mean(computeThresholdMap(grating(256, 32.0), kStudyPpd, settings(7)));
  };
  // Doubling Gaussians: bands correspond but for the finest one near, whose share of the contrasts is 1 -
  // exp(-(2 pi 1.29 / 64)^2 / 2) = 0.8 % of the grating's, beside some 0.6 in the others.
  EXPECT_NEAR(ratio("true_stack"), 1.0, 0.02);
  // A pyramid's variance at level 2 is 5 % short of doubling twice, which its contrasts follow; they enter
  // the elevation with a power below 2.
  EXPECT_NEAR(ratio("stack"), 1.0, 0.1);
}

TEST(ThresholdMap, AdaptsToOneDegree) {
  for (const double ppd : {24.0, 32.0, kStudyPpd, 46.0, 60.0})
    for (const char* decomposition : {"stack", "pyramid", "true_stack"}) {
      const Plane edge = edgePattern(512, 64);
      const ThresholdMap map = computeThresholdMap(
          edge, ppd, settingsOf({{"decomposition", text(decomposition)}, {"levels", int64_t{7}}}));
      EXPECT_NEAR(edgeSupportPx(map.adaptationCdM2) / ppd, 1.0, 0.2) << decomposition << ' ' << ppd;
    }
}

TEST(ThresholdMap, AResolutionTakenForAKernelSizeIsNotOneDegree) {
  // The published mistake: in an image N = 2 tan(fov / 2) / 0.01745 pixels wide each covers a degree, but N
  // is used as the width of the averaging filter in the image of W pixels: N^2 / W degrees.
  for (const auto& [fovDeg, width, degrees] :
       {std::tuple(10.0, 512, 0.196), {15.0, 512, 0.445}, {20.0, 512, 0.798}, {45.0, 1024, 2.20}}) {
    const double ppd = width / (2.0 * std::tan(fovDeg * M_PI / 360.0)) * std::tan(M_PI / 180.0);
    const ThresholdMap map = computeThresholdMap(edgePattern(width, 8), ppd,
                                                 settingsOf({{"adaptation", text("mistaken_degree")}}));
    const double support = edgeSupportPx(map.adaptationCdM2) / ppd;
    EXPECT_NEAR(support, degrees, 0.05 * degrees);  // N is rounded to whole pixels
    EXPECT_GT(std::abs(support - 1.0), 0.19) << "the criterion must reject it";
  }
}

TEST(ThresholdMap, AStackThatDoesNotDoubleIsCaughtByItsPeaks) {
  // The model reads the CSF where a pyramid's bands peak; bands of a kernel applied repeatedly peak
  // elsewhere.
  const ThresholdMapSettings settings =
      settingsOf({{"decomposition", text("repeated")}, {"levels", int64_t{6}}});
  const auto decompose = [&](const Plane& image) {
    return computeThresholdMap(image, kStudyPpd, settings).levels;
  };
  const ThresholdModel model(settings, kStudyPpd, 256, 64);
  GratingSweep sweep;
  sweep.widthPx = 256;
  sweep.heightPx = 32;
  sweep.lowestCyclesPerPx = 0.03;
  sweep.step = 1.08;
  EXPECT_THROW(requirePeaks(measureBandPeaks(decompose, 3, sweep), model.peaks(), "repeated"), Error);
  // The same check lets the dilated form of the pyramid pass.
  const auto right = [&](const Plane& image) {
    PyramidSettings pyramid;
    pyramid.levels = 6;
    return dilatedStack(image, pyramid);
  };
  const auto peaks = bandPeaks(Kernel::binomial5(), Upsampler::Successive, PeakModel::NoUpsample, 3);
  EXPECT_NO_THROW(requirePeaks(measureBandPeaks(right, 3, sweep), peaks, "dilated"));
}

TEST(ThresholdMap, EveryComponentCanBeSwitchedOffAndMatters) {
  const Plane image = picture(128, 96);
  const Plane whole = computeThresholdMap(image, kStudyPpd, {}).thresholdCdM2;
  const std::vector<std::map<std::string, ParameterValue>> ablations = {
      {{"masking", text("none")}},
      {{"frequency_elevation", text("none")}},
      {{"frequency_elevation", text("original")}},
      {{"peak_model", text("halving")}},
      {{"gain_compensation", true}},
      {{"adaptation", text("level")}, {"adaptation.level", int64_t{0}}},
      {{"tvi", text("from_csf")}},
      {{"decomposition", text("pyramid")}},
      {{"decomposition", text("true_stack")}},
      {{"tvi_factor", 1.0}}};
  for (const auto& given : ablations) {
    const Plane without = computeThresholdMap(image, kStudyPpd, settingsOf(given)).thresholdCdM2;
    double largest = 0.0;
    for (size_t i = 0; i < whole.data.size(); ++i)
      largest = std::max(largest, std::abs(without.data[i] / whole.data[i] - 1.0));
    EXPECT_GT(largest, 0.01) << given.begin()->first;
  }
}

TEST(ThresholdMap, HalvedPeaksMissTheSecondBandByFiveCyclesPerDegree) {
  // At 41.07 ppd the second band is read at 10.27 cpd, where it lies at 5.18 (six taps).
  const auto image =
      pattern(128, 128, [](int x, int) { return 60.0 + 12.0 * std::cos(2.0 * M_PI * 0.126 * x); });
  const Plane right = computeThresholdMap(image, kStudyPpd, {}).thresholdCdM2;
  const Plane wrong =
      computeThresholdMap(image, kStudyPpd, settingsOf({{"peak_model", text("halving")}})).thresholdCdM2;
  double ratio = 0.0;
  for (int x = 40; x < 88; ++x) ratio += wrong.at(x, 64) / right.at(x, 64) / 48.0;
  EXPECT_GT(std::abs(ratio - 1.0), 0.1);
}

TEST(ThresholdMap, StackIsSmootherThanThePyramid) {
  const Plane image = noisePattern(192, 128);
  const auto ratio = [&](const char* decomposition) {
    const ThresholdMap map =
        computeThresholdMap(image, kStudyPpd, settingsOf({{"decomposition", text(decomposition)}}));
    // Band 2 is made of levels 2 to 4: the grid of level 3 is its kink.
    return blockMetric(map.levels[3], 3).ratio();
  };
  EXPECT_GT(ratio("pyramid"), 100.0);
  EXPECT_LT(ratio("stack"), 3.0);
}

TEST(ThresholdMap, DecisionsFlipWhereADifferenceLiesBetweenTwoMaps) {
  Plane a(4, 1), b(4, 1), difference(4, 1);
  a.data = {1, 1, 1, 1};
  b.data = {2, 2, 0.5, 1};
  difference.data = {1.5, -1.5, 0.1, 3};
  EXPECT_DOUBLE_EQ(decisionFlips(a, b, difference), 0.5);
}

}  // namespace
}  // namespace limen::perception
