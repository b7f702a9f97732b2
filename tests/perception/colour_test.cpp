// SPDX-License-Identifier: BSD-3-Clause
#include "perception/vision/colour.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "metric_helpers.h"

namespace limen::perception {
namespace {

TEST(Colour, SrgbCurveAtKnownPoints) {
  EXPECT_EQ(encodeSrgb(0.0), 0.0);
  EXPECT_NEAR(encodeSrgb(1.0), 1.0, 1e-12);
  // ((0.5 + 0.055) / 1.055)^2.4 = 0.2140411
  EXPECT_NEAR(encodeSrgb(0.2140411), 0.5, 1e-6);
  EXPECT_NEAR(encodeSrgb(0.001), 0.01292, 1e-12);
}

TEST(Colour, WhiteAndGreysHaveNoChroma) {
  const Lab white = labFromLinearRgb({1.0, 1.0, 1.0});
  EXPECT_NEAR(white.lightness, 100.0, 1e-12);
  for (const double v : {0.0, 1e-4, 0.01, 0.18, 0.5, 1.0}) {
    const Lab grey = labFromLinearRgb({v, v, v});
    EXPECT_NEAR(grey.a, 0.0, 1e-10);
    EXPECT_NEAR(grey.b, 0.0, 1e-10);
  }
  EXPECT_NEAR(labFromLinearRgb({0.0, 0.0, 0.0}).lightness, 0.0, 1e-12);
  // CIE 15: L* of 18 % grey is 116 * 0.18^(1/3) - 16 = 49.496.
  EXPECT_NEAR(labFromLinearRgb({0.18, 0.18, 0.18}).lightness, 49.4961, 1e-4);
}

// CIELAB of the sRGB primaries as commonly tabled for D65; the tables' white differs in the fifth digit.
TEST(Colour, PrimariesMatchTables) {
  const struct {
    std::array<double, 3> rgb;
    double lightness, a, b;
  } kTable[] = {{{1, 0, 0}, 53.2408, 80.0925, 67.2032},
                {{0, 1, 0}, 87.7347, -86.1827, 83.1793},
                {{0, 0, 1}, 32.2970, 79.1875, -107.8602}};
  for (const auto& row : kTable) {
    const Lab lab = labFromLinearRgb(row.rgb);
    EXPECT_NEAR(lab.lightness, row.lightness, 0.02);
    EXPECT_NEAR(lab.a, row.a, 0.02);
    EXPECT_NEAR(lab.b, row.b, 0.02);
  }
}

// Pairs of Sharma, Wu and Dalal (2005). By hand for the first: C1 = sqrt(2.6772^2 + 79.7751^2) = 79.8200, C2
// = 82.7485, dC^2 = 8.5761, dH^2 = 2.6772^2 + 2.9734^2 - 8.5761 = 7.4322, SC = 1 + 0.045 C1 = 4.5919, SH = 1
// + 0.015 C1 = 2.1973: sqrt(8.5761 / 21.0855 + 7.4322 / 4.8281) = 1.3950. For the second: C1 = 2.5, C2
// = 30.8058, dL = -23, dC^2 = 801.219, dH^2 = 29.031: sqrt(529 + 801.219 / 1.237656 + 29.031 / 1.076406)
// = 34.6892.
TEST(Cie94, PublishedPairs) {
  EXPECT_NEAR(differenceCie94({50.0, 2.6772, -79.7751}, {50.0, 0.0, -82.7485}), 1.3950, 1e-4);
  EXPECT_NEAR(differenceCie94({50.0, 2.5, 0.0}, {73.0, 25.0, -18.0}), 34.6892, 2e-4);
}

TEST(Cie94, GreysDifferByLightnessAlone) {
  EXPECT_DOUBLE_EQ(differenceCie94({20.0, 0.0, 0.0}, {70.0, 0.0, 0.0}), 50.0);
  EXPECT_EQ(differenceCie94({20.0, 5.0, 7.0}, {20.0, 5.0, 7.0}), 0.0);
}

// Chroma 10 against 0: weighed by the reference's chroma, 10 / 1.45 one way and 10 the other.
TEST(Cie94, IsWeighedByTheReferencesChroma) {
  EXPECT_NEAR(differenceCie94({50.0, 10.0, 0.0}, {50.0, 0.0, 0.0}), 10.0 / 1.45, 1e-12);
  EXPECT_NEAR(differenceCie94({50.0, 0.0, 0.0}, {50.0, 10.0, 0.0}), 10.0, 1e-12);
}

// Black against white is a difference of 100 in lightness, which one pixel in four has.
TEST(De94, StatisticsPoolThePixels) {
  const Image reference(2, 2, 1, 0.0F), test = makeImage(2, 2, 1, {0.0F, 0.0F, 0.0F, 1.0F});
  EXPECT_NEAR(valueOf("de94", test, reference), 25.0, 1e-10);
  EXPECT_NEAR(valueOf("de94", test, reference, {{"statistic", std::string("max")}}), 100.0, 1e-10);
  EXPECT_NEAR(valueOf("de94", test, reference, {{"statistic", std::string("p99")}}), 100.0, 1e-10);
  EXPECT_EQ(valueOf("de94", reference, reference), 0.0);
}

TEST(De94, ValuesBeyondTheDisplayAreClamped) {
  const Image bright(1, 1, 4, 7.0F), white(1, 1, 4, 1.0F), dark(1, 1, 4, -2.0F), black(1, 1, 4, 0.0F);
  EXPECT_EQ(valueOf("de94", bright, white), 0.0);
  EXPECT_EQ(valueOf("de94", dark, black), 0.0);
}

TEST(De94, NonFiniteValuesShowTheFartherEnd) {
  const Image nan(1, 1, 1, std::numeric_limits<float>::quiet_NaN());
  EXPECT_NEAR(valueOf("de94", nan, Image(1, 1, 1, 0.0F)), 100.0, 1e-10);
  EXPECT_NEAR(valueOf("de94", nan, Image(1, 1, 1, 1.0F)), 100.0, 1e-10);
}

TEST(De94, GreyVisibilityEqualsGreyColour) {
  const Image a = randomImage(5, 4, 1, 5), b = randomImage(5, 4, 1, 6);
  Image colourA(5, 4, 3), colourB(5, 4, 3);
  for (size_t i = 0; i < colourA.data.size(); ++i)
    colourA.data[i] = a.data[i / 3], colourB.data[i] = b.data[i / 3];
  EXPECT_DOUBLE_EQ(valueOf("de94", a, b), valueOf("de94", colourA, colourB));
}

}  // namespace
}  // namespace limen::perception
