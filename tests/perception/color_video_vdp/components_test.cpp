// SPDX-License-Identifier: BSD-3-Clause
// Single stages of ColorVideoVDP against those of the authors' program (reference/components.csv).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "experiments/base/error.h"
#include "perception/metrics/color_video_vdp/pooling.h"
#include "perception/metrics/color_video_vdp/pyramid.h"
#include "perception/metrics/color_video_vdp/reference.h"
#include "perception/metrics/color_video_vdp/sensitivity.h"
#include "vectors.h"

namespace limen::perception::cvvdp {
namespace {

std::vector<Row> rowsOf(const std::string& function) {
  std::vector<Row> out;
  for (Row& row : readRows("components.csv"))
    if (row.at("function") == function) out.push_back(std::move(row));
  EXPECT_FALSE(out.empty()) << function;
  return out;
}

int channelOf(const std::string& name) {
  for (int c = 0; c < kChannels; ++c)
    if (name == kChannelNames[static_cast<size_t>(c)]) return c;
  ADD_FAILURE() << name;
  return 0;
}

Plane pyramidInput(int width, int height) {
  Plane out(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) out.at(x, y) = 10.0 * y + 1.0 * x * x;
  return out;
}

TEST(CvvdpComponents, PixelsPerDegreeOfDisplays) {
  for (const Row& row : rowsOf("ppd"))
    EXPECT_NEAR(readDisplay(row.at("display_or_key")).pixelsPerDegree, number(row, "out0"), 1e-9);
}

// Printed to 14 digits.
TEST(CvvdpComponents, DisplaysTurnValuesIntoLightAndOpponentChannels) {
  for (const Row& row : rowsOf("display_rgb_to_RGBlin_DKL")) {
    const Display display = readDisplay(row.at("display_or_key"));
    const glm::dvec3 light = display.light({number(row, "arg0"), number(row, "arg1"), number(row, "arg2")});
    const glm::dvec3 dkl = display.colours.dklOfRgb() * light;
    // Opponent channels are differences of light: their error is relative to that.
    const double scale = std::max({light.x, light.y, light.z});
    for (int c = 0; c < 3; ++c) {
      const double out = number(row, "out" + std::to_string(c));
      EXPECT_NEAR(light[c], out, 1e-10 * out) << display.name;
      EXPECT_NEAR(dkl[c], number(row, "out" + std::to_string(3 + c)), 1e-10 * scale) << display.name;
    }
  }
}

TEST(CvvdpComponents, SensitivityInsideAndOutsideTheTable) {
  const std::vector<std::string> tables = {"o0_c1", "o0_c2", "o0_c3", "o5_c1"};
  for (const Row& row : rowsOf("csf")) {
    const auto table = std::find(tables.begin(), tables.end(), row.at("display_or_key")) - tables.begin();
    const Sensitivity sensitivity(static_cast<int>(table), number(row, "arg0"));
    // The table is without the correction, -0.2797 dB.
    const double out = 0.96830658 * number(row, "out0");
    EXPECT_NEAR(sensitivity.at(std::log10(number(row, "arg1"))), out, 1e-8 * out);  // the factor has 8 digits
  }
}

TEST(CvvdpComponents, TemporalTaps) {
  for (const Row& row : rowsOf("temporal_tap")) {
    const double rate = number(row, "arg0");
    const std::vector<double> taps = temporalFilter(channelOf(row.at("display_or_key")), rate);
    ASSERT_EQ(static_cast<double>(taps.size()), number(row, "arg2"));
    EXPECT_NEAR(taps[static_cast<size_t>(number(row, "arg1"))], number(row, "out0"), 1e-12) << rate;
  }
}

TEST(CvvdpComponents, JodOfDifferences) {
  for (const Row& row : rowsOf("met2jod"))
    EXPECT_NEAR(jodOf(number(row, "arg0")), number(row, "out0"), 1e-11);
  EXPECT_NEAR(jodOf(0.1 * (1.0 - 1e-12)), jodOf(0.1 * (1.0 + 1e-12)), 1e-12);
}

TEST(CvvdpComponents, PyramidOfEvenAndOddSizes) {
  for (const std::string function : {"pyramid_reduced", "pyramid_expanded"})
    for (const Row& row : rowsOf(function)) {
      const std::string& size = row.at("display_or_key");
      const int width = std::stoi(size), height = std::stoi(size.substr(size.find('x') + 1));
      Plane out = reduce(pyramidInput(width, height), true);
      if (function == "pyramid_expanded") out = expand(out, width, height);
      EXPECT_NEAR(out.at(static_cast<int>(number(row, "arg0")), static_cast<int>(number(row, "arg1"))),
                  number(row, "out0"), 1e-10)
          << function << size;
    }
}

// The kernels add up to 1, so only a wrong border can change a constant image.
TEST(CvvdpComponents, RepairedBordersPreserveAConstant) {
  for (int width = 4; width <= 7; ++width)
    for (int height = 4; height <= 7; ++height) {
      const Plane coarse = reduce(Plane(width, height, 3.0), false);
      for (const double value : coarse.data) EXPECT_NEAR(value, 3.0, 1e-14);
      for (const double value : expand(coarse, width, height).data) EXPECT_NEAR(value, 3.0, 1e-14);
    }
  // The authors' gain at the right border, from the missing or doubled taps: 1 - 0.25 or 1 + 0.25.
  const Plane wide = reduce(Plane(6, 5, 1.0), true), tall = reduce(Plane(5, 6, 1.0), true);
  EXPECT_NEAR(wide.at(2, 1), 1.25, 1e-14);
  EXPECT_NEAR(tall.at(2, 1), 0.75, 1e-14);
}

TEST(CvvdpComponents, MaskerIsBlurredWithMirroredBorders) {
  Plane identity(13, 13);
  for (int i = 0; i < 13; ++i) identity.at(i, i) = 1.0;
  const Plane out = blurMasker(identity);
  for (const Row& row : rowsOf("blur13_of_identity_row6"))
    EXPECT_NEAR(out.at(static_cast<int>(number(row, "arg0")), 6), number(row, "out0"), 1e-12);
  const Plane small(6, 20, 2.0);
  EXPECT_EQ(blurMasker(small).data, small.data);
}

// Written out from the rule by hand: 0 1 2 3 played backwards before the start, without its first frame.
TEST(CvvdpComponents, SymmetricPaddingMirrorsTheVideo) {
  const std::vector<int> expected = {1, 2, 3, 2, 1, 0, 1, 2, 3};  // frames -1, -2, ... of a video of 4
  for (size_t i = 0; i < expected.size(); ++i)
    EXPECT_EQ(paddedFrame(-1 - static_cast<int>(i), 4, TemporalPadding::Symmetric), expected[i]) << i;
  for (int frames = 2; frames <= 20; ++frames)
    for (int t = -40; t < 0; ++t) {
      const int padded = paddedFrame(t, frames, TemporalPadding::Symmetric);
      EXPECT_TRUE(padded >= 0 && padded < frames);
      EXPECT_EQ(paddedFrame(t, frames, TemporalPadding::Replicate), 0);
    }
}

TEST(CvvdpComponents, RefusesWhatItCannotEvaluate) {
  const auto grey = [](int) { return Image(3, 8, 1, 0.5F); };
  Options options;
  options.display = readDisplay("standard_4k");
  EXPECT_THROW(evaluate({3, 8, 1, grey, grey}, options), Error);
  EXPECT_THROW(evaluate({8, 8, 2, grey, grey}, options), Error);  // no frame rate
  EXPECT_THROW(readDisplay("standard_5k"), Error);
  options.display = readDisplay("standard_hdr_pq");
  options.values = Values::Relative;
  EXPECT_THROW(evaluate({8, 8, 1, grey, grey}, options), Error);
}

// What is shown as grey is grey, whichever way it is stored, and light is what its code stands for.
TEST(CvvdpComponents, GreyEqualsColourAndLightEqualsCode) {
  const int width = 24, height = 20;
  Image test(width, height, 1), reference(width, height, 1), testLight(width, height, 3),
      referenceLight = testLight, testColour = testLight, referenceColour = testLight;
  const auto decode = [](double v) { return v > 0.04045 ? std::pow((v + 0.055) / 1.055, 2.4) : v / 12.92; };
  for (int i = 0; i < width * height; ++i) {
    const auto n = static_cast<size_t>(i);
    test.data[n] = static_cast<float>(i * 37 % 101) / 101.0F;
    reference.data[n] = static_cast<float>(i * 53 % 89) / 89.0F;
    for (size_t c = 0; c < 3; ++c) {
      testColour.data[3 * n + c] = test.data[n], referenceColour.data[3 * n + c] = reference.data[n];
      testLight.data[3 * n + c] = static_cast<float>(decode(test.data[n]));
      referenceLight.data[3 * n + c] = static_cast<float>(decode(reference.data[n]));
    }
  }
  Options options;
  options.display = readDisplay("standard_fhd");
  const auto jod = [&](const Image& a, const Image& b) {
    return evaluate({width, height, 1, [&](int) { return a; }, [&](int) { return b; }}, options).score.jod;
  };
  const double grey = jod(test, reference);
  EXPECT_EQ(grey, jod(testColour, referenceColour));
  options.values = Values::Relative;
  EXPECT_NEAR(grey, jod(testLight, referenceLight), 1e-5);  // light in single precision
}

}  // namespace
}  // namespace limen::perception::cvvdp
