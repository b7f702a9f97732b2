// SPDX-License-Identifier: BSD-3-Clause
#include "perception/multiscale/band_peaks.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "experiments/base/error.h"

namespace limen::perception {
namespace {

struct TableRow {
  double fiveF, fiveGain, sixF, sixGain;
};
/// Band peaks in cycles per pixel and gains, as tabulated for the binomial kernel and its fused form from the
/// products of |cos|^4 and |cos|^5; printed to five digits.
const std::vector<TableRow> kTable = {
    {0.5, 1.0000, 0.5, 1.0000},           {0.14050, 0.55965, 0.12605, 0.55418},
    {0.06683, 0.50978, 0.05986, 0.50465}, {0.03303, 0.49877, 0.02958, 0.49373},
    {0.01647, 0.49610, 0.01475, 0.49108}, {0.00823, 0.49544, 0.00737, 0.49042},
};

TEST(BandPeaks, OfTheTransferFunctionsAreThoseOfTheTable) {
  const auto five = bandPeaks(Kernel::binomial5(), Upsampler::Successive, PeakModel::NoUpsample, 6);
  const auto six = bandPeaks(Kernel::fused6(), Upsampler::Successive, PeakModel::NoUpsample, 6);
  for (size_t i = 0; i < kTable.size(); ++i) {
    EXPECT_NEAR(five[i].frequencyCyclesPerPx, kTable[i].fiveF, 6e-6) << i;
    EXPECT_NEAR(five[i].gain, kTable[i].fiveGain, 6e-6) << i;
    EXPECT_NEAR(six[i].frequencyCyclesPerPx, kTable[i].sixF, 6e-6) << i;
    EXPECT_NEAR(six[i].gain, kTable[i].sixGain, 6e-6) << i;
  }
  // "almost four" between the first two, in the thesis's words.
  EXPECT_NEAR(six[0].frequencyCyclesPerPx / six[1].frequencyCyclesPerPx, 3.97, 0.005);
  EXPECT_NEAR(five[0].frequencyCyclesPerPx / five[1].frequencyCyclesPerPx, 3.56, 0.005);
}

TEST(BandPeaks, WithTheUpsamplingFilterAreThoseTabulated) {
  const std::vector<double> fiveF = {0.5, 0.11584, 0.05554, 0.02751, 0.01372};
  const std::vector<double> fiveGain = {1, 0.689, 0.646, 0.637, 0.634};
  const std::vector<double> sixF = {0.5, 0.11094, 0.05301, 0.02623, 0.01308};
  const std::vector<double> sixGain = {1, 0.646, 0.600, 0.590, 0.588};
  const auto five = bandPeaks(Kernel::binomial5(), Upsampler::Expand, PeakModel::WithUpsample, 5);
  const auto six = bandPeaks(Kernel::fused6(), Upsampler::Bilinear, PeakModel::WithUpsample, 5);
  for (size_t i = 0; i < fiveF.size(); ++i) {
    EXPECT_NEAR(five[i].frequencyCyclesPerPx, fiveF[i], 6e-6) << i;
    EXPECT_NEAR(five[i].gain, fiveGain[i], 6e-4) << i;
    EXPECT_NEAR(six[i].frequencyCyclesPerPx, sixF[i], 6e-6) << i;
    EXPECT_NEAR(six[i].gain, sixGain[i], 6e-4) << i;
  }
}

TEST(BandPeaks, FiveBandsReachDownToHalfACyclePerDegree) {
  const auto peaks = bandPeaks(Kernel::binomial5(), Upsampler::Successive, PeakModel::NoUpsample, 6);
  EXPECT_GT(peaks[4].frequencyCpd(41.07), 0.5);
  EXPECT_LT(peaks[5].frequencyCpd(41.07), 0.5);
  EXPECT_NEAR(peaks[1].frequencyCpd(41.07), 5.771, 0.001);
}

TEST(BandPeaks, OfADoublingGaussianSatisfyTheClosedForm) {
  // exp(-u/2) - exp(-2u), u = (w sigma)^2, is largest where u = lg(4) / 1.5 (natural log): w sigma = 0.96135.
  const double sigma = 1.5;
  const auto peaks = stackBandPeaks(Kernel::binomial5(), 4, sigma);
  for (int i = 1; i < 4; ++i) {
    const double expected = std::sqrt(std::log(4.0) / 1.5) / (std::ldexp(sigma, i - 1) * 2.0 * M_PI);
    EXPECT_NEAR(peaks[static_cast<size_t>(i)].frequencyCyclesPerPx / expected, 1.0, 1e-6);
    EXPECT_NEAR(peaks[static_cast<size_t>(i)].gain, 0.47247, 5e-6);
  }
}

/// Sends gratings through real pyramids: two ways to the same figures.
void expectMeasured(const PyramidSettings& settings, bool upsampled, const std::vector<BandPeak>& expected) {
  GratingSweep sweep;
  sweep.heightPx = 32;
  sweep.upsampled = upsampled;
  sweep.settings = settings;
  const auto measured =
      measureBandPeaks([&](const Plane& image) { return gaussianPyramid(image, settings); }, 5, sweep);
  for (size_t i = 0; i < expected.size(); ++i) {
    // At Nyquist band 0 is flat to one part in 10^4 over some percent of frequency.
    const double tolerance = i == 0 && upsampled ? 0.05 : 0.02;
    EXPECT_NEAR(measured[i].frequencyCyclesPerPx / expected[i].frequencyCyclesPerPx, 1.0, tolerance) << i;
    EXPECT_NEAR(measured[i].gain / expected[i].gain, 1.0, 0.02) << i;
  }
  EXPECT_NO_THROW(requirePeaks(measured, expected, "test"));
}

TEST(BandPeaks, GratingsThroughThePyramidFindThem) {
  PyramidSettings settings;
  settings.levels = 6;
  std::vector<BandPeak> five, six;
  for (size_t i = 0; i < 5; ++i) {
    five.push_back({kTable[i].fiveF, kTable[i].fiveGain});
    six.push_back({kTable[i].sixF, kTable[i].sixGain});
  }
  settings.kernel = Kernel::binomial5();
  expectMeasured(settings, false, five);
  settings.kernel = Kernel::fused6();
  expectMeasured(settings, false, six);
}

TEST(BandPeaks, GratingsFindThoseWithTheUpsamplingFilter) {
  PyramidSettings settings;
  settings.levels = 6;
  settings.kernel = Kernel::binomial5();
  settings.upsampler = Upsampler::Expand;
  expectMeasured(settings, true,
                 {{0.5, 1}, {0.11584, 0.689}, {0.05554, 0.646}, {0.02751, 0.637}, {0.01372, 0.634}});
  settings.kernel = Kernel::fused6();
  settings.upsampler = Upsampler::Bilinear;
  expectMeasured(settings, true,
                 {{0.5, 1}, {0.11094, 0.646}, {0.05301, 0.600}, {0.02623, 0.590}, {0.01308, 0.588}});
}

TEST(BandPeaks, ASmallKernelAppliedRepeatedlyIsRefused) {
  // Levels of |cos(w/2)|^4i differ most at 7.48, 5.79, 4.90, 4.33 cpd at 41.07 ppd, with gains .25, .148,
  // .105, .082 (derivation: x^i (1 - x), x = cos^4, peaks at x = i / (i + 1)), where a pyramid's lie at 5.77
  // ...
  PyramidSettings settings;
  settings.levels = 6;
  GratingSweep sweep;
  sweep.heightPx = 32;
  sweep.settings = settings;
  const auto measured =
      measureBandPeaks([&](const Plane& image) { return repeatedStack(image, settings); }, 5, sweep);
  for (int i = 1; i < 5; ++i) {
    const double x = static_cast<double>(i) / (i + 1);
    const double frequency = std::acos(std::pow(x, 0.25)) / M_PI;
    EXPECT_NEAR(measured[static_cast<size_t>(i)].frequencyCyclesPerPx / frequency, 1.0, 0.02) << i;
    EXPECT_NEAR(measured[static_cast<size_t>(i)].gain, std::pow(x, i) * (1.0 - x), 0.005) << i;
  }
  EXPECT_NEAR(measured[1].frequencyCpd(41.07), 7.48, 0.1);
  EXPECT_NEAR(measured[4].frequencyCpd(41.07), 4.33, 0.1);
  const auto assumed = bandPeaks(settings.kernel, settings.upsampler, PeakModel::NoUpsample, 5);
  EXPECT_GT(largestPeakMismatch(measured, assumed), kLargestAllowedPeakMismatch);
  EXPECT_THROW(requirePeaks(measured, assumed, "stack"), Error);
}

TEST(BandPeaks, HalvedEveryLevelAreRefused) {
  const auto actual = bandPeaks(Kernel::binomial5(), Upsampler::Successive, PeakModel::NoUpsample, 5);
  const auto halving = bandPeaks(Kernel::binomial5(), Upsampler::Successive, PeakModel::Halving, 5);
  EXPECT_NEAR(halving[1].frequencyCpd(41.07), 10.27, 0.005);
  EXPECT_THROW(requirePeaks(actual, halving, "halving"), Error);
}

TEST(BandPeaks, ModelsAreKnownByName) {}

TEST(BandPeaks, GainsAreThoseOfTheReferenceVectors) {
  // W_i = prod |cos(2^k w/2)|^p (1 - |cos(2^i w/2)|^p), worked out by hand: level 0 at a quarter cycle is
  // 1 - (1/sqrt 2)^4 = 3/4.
  EXPECT_NEAR(bandTransfer(Kernel::binomial5(), Upsampler::Successive, PeakModel::NoUpsample, 0, M_PI / 2),
              0.75, 1e-15);
  std::ifstream file(LIMEN_SOURCE_DIR "/tests/perception/reference/vision_vectors.csv");
  int rows = 0;
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("band_gain,", 0) != 0) continue;
    std::vector<std::string> cells;
    std::stringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    const Kernel kernel = cells[1] == "4" ? Kernel::binomial5() : Kernel::fused6();
    const double gain = bandTransfer(kernel, Upsampler::Successive, PeakModel::NoUpsample,
                                     std::stoi(cells[2]), 2.0 * M_PI * std::stod(cells[3]));
    EXPECT_NEAR(gain, std::stod(cells[7]), 1e-12 + 1e-9 * std::stod(cells[7])) << line;
    ++rows;
  }
  EXPECT_GT(rows, 5);
}

}  // namespace
}  // namespace limen::perception
