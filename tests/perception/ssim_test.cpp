// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "metric_helpers.h"

namespace limen::perception {
namespace {

constexpr double kC1 = 1e-4, kC2 = 9e-4;

double decode(double coded) {
  return coded <= 0.04045 ? coded / 12.92 : std::pow((coded + 0.055) / 1.055, 2.4);
}
double encode(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

/// Visibility image whose sRGB code is `coded`.
Image fromCoded(const Image& coded) {
  Image linear = coded;
  for (float& value : linear.data) value = static_cast<float>(decode(value));
  return linear;
}

/// The definition, window by window, with a two-dimensional kernel and central moments.
double bruteForce(const Image& test, const Image& reference) {
  const int w = std::min(11, test.width), h = std::min(11, test.height);
  std::vector<double> kernel;
  double kernelSum = 0.0;
  for (int j = 0; j < h; ++j)
    for (int i = 0; i < w; ++i) {
      const double x = i - 0.5 * (w - 1), y = j - 0.5 * (h - 1);
      kernel.push_back(std::exp(-(x * x + y * y) / (2.0 * 1.5 * 1.5)));
      kernelSum += kernel.back();
    }
  double total = 0.0;
  int windows = 0;
  for (int top = 0; top + h <= test.height; ++top)
    for (int left = 0; left + w <= test.width; ++left, ++windows) {
      const auto average = [&](auto value) {
        double sum = 0.0;
        for (int j = 0; j < h; ++j)
          for (int i = 0; i < w; ++i)
            sum += kernel[static_cast<size_t>(j * w + i)] / kernelSum * value(left + i, top + j);
        return sum;
      };
      const auto t = [&](int x, int y) { return encode(test.at(x, y)); };
      const auto r = [&](int x, int y) { return encode(reference.at(x, y)); };
      const double mt = average(t), mr = average(r);
      const double vt = average([&](int x, int y) { return (t(x, y) - mt) * (t(x, y) - mt); });
      const double vr = average([&](int x, int y) { return (r(x, y) - mr) * (r(x, y) - mr); });
      const double cov = average([&](int x, int y) { return (t(x, y) - mt) * (r(x, y) - mr); });
      total += (2 * mt * mr + kC1) * (2 * cov + kC2) / ((mt * mt + mr * mr + kC1) * (vt + vr + kC2));
    }
  return total / windows;
}

TEST(Ssim, EqualImagesScoreOne) {
  const Image image = randomImage(20, 15, 4, 1);
  EXPECT_EQ(valueOf("ssim", image, image), 1.0);
}

// Flat images have no variance: (2ab + C1) / (a^2 + b^2 + C1).
TEST(Ssim, FlatImagesInClosedForm) {
  EXPECT_NEAR(valueOf("ssim", Image(16, 16, 1, 0.0F), Image(16, 16, 1, 1.0F)), kC1 / (1.0 + kC1), 1e-12);
  const double a = encode(0.25), b = encode(0.5);
  EXPECT_NEAR(valueOf("ssim", Image(16, 16, 1, 0.25F), Image(16, 16, 1, 0.5F)),
              (2 * a * b + kC1) / (a * a + b * b + kC1), 1e-12);
}

// Shifting the code by a constant leaves variances and covariance alone, so that only the means' factor is
// left. A checkerboard of 0.3 and 0.5 seen through one window has the mean 0.4 + 0.1 s with s the kernel's
// alternating sum.
TEST(Ssim, ConstantShiftInClosedForm) {
  Image test(11, 11, 1), reference(11, 11, 1);
  double alternating = 0.0, sum = 0.0;
  for (int x = 0; x < 11; ++x) {
    const double weight = std::exp(-(x - 5.0) * (x - 5.0) / 4.5);
    alternating += (x % 2 ? -1.0 : 1.0) * weight, sum += weight;
  }
  const double s = alternating / sum * (alternating / sum);
  for (int y = 0; y < 11; ++y)
    for (int x = 0; x < 11; ++x) {
      reference.at(x, y) = (x + y) % 2 ? 0.3F : 0.5F;
      test.at(x, y) = reference.at(x, y) + 0.2F;
    }
  const double mr = 0.4 + 0.1 * s, mt = mr + 0.2;
  EXPECT_NEAR(valueOf("ssim", fromCoded(test), fromCoded(reference)),
              (2 * mr * mt + kC1) / (mr * mr + mt * mt + kC1), 1e-6);
}

TEST(Ssim, MatchesTheDefinitionWindowByWindow) {
  for (const auto& [w, h] : {std::pair{17, 13}, {11, 11}, {40, 12}, {13, 150}, {12, 74}, {12, 75}}) {
    const Image a = randomImage(w, h, 1, 1), b = randomImage(w, h, 1, 2);
    EXPECT_NEAR(valueOf("ssim", a, b), bruteForce(a, b), 1e-10) << w << " x " << h;
  }
}

TEST(Ssim, SmallImagesShrinkTheWindow) {
  for (const auto& [w, h] : {std::pair{1, 1}, {5, 3}, {4, 20}, {10, 11}}) {
    const Image a = randomImage(w, h, 1, 3), b = randomImage(w, h, 1, 4);
    const MetricResult result = measure("ssim", pairOf(a, b));
    EXPECT_NEAR(result.value, bruteForce(a, b), 1e-10) << w << " x " << h;
    EXPECT_EQ(result.map->width, w);
    EXPECT_EQ(result.map->height, h);
  }
}

TEST(Ssim, MapIsWorstWhereTheDifferenceIs) {
  Image test(31, 31, 1, 0.5F), reference(31, 31, 1, 0.5F);
  test.at(20, 9) = 0.0F;
  const Image map = *measure("ssim", pairOf(test, reference)).map;
  const auto worst = std::max_element(map.data.begin(), map.data.end()) - map.data.begin();
  EXPECT_EQ(worst, 9 * 31 + 20);
  EXPECT_EQ(map.at(2, 28), 0.0F);
}

TEST(Ssim, GreyColourScoresAsVisibility) {
  const Image a = randomImage(15, 12, 1, 5), b = randomImage(15, 12, 1, 6);
  Image colourA(15, 12, 3), colourB(15, 12, 3);
  for (size_t i = 0; i < colourA.data.size(); ++i)
    colourA.data[i] = a.data[i / 3], colourB.data[i] = b.data[i / 3];
  EXPECT_NEAR(valueOf("ssim", colourA, colourB), valueOf("ssim", a, b), 1e-12);
}

}  // namespace
}  // namespace limen::perception
