// SPDX-License-Identifier: BSD-3-Clause
// Structural similarity after Wang, Bovik, Sheikh and Simoncelli, "Image Quality Assessment: From Error
// Visibility to Structural Similarity", IEEE Transactions on Image Processing 13(4), 2004: Gaussian window of
// 11 x 11 pixels with standard deviation 1.5, K1 = 0.01, K2 = 0.03, only windows entirely within the image.
// An image smaller than the window is evaluated with a window of the image's size. The image evaluated is
// Rec. 709 luminance in sRGB coding, range 1.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "perception/metrics/comparison.h"
#include "perception/metrics/row_sums.h"
#include "perception/vision/colour.h"

namespace limen::perception {
namespace {

constexpr int kWindow = 11;
constexpr double kSigma = 1.5;
constexpr double kC1 = 0.01 * 0.01, kC2 = 0.03 * 0.03;

std::vector<double> windowWeights(int count) {
  std::vector<double> weights;
  double sum = 0.0;
  for (int i = 0; i < count; ++i) {
    const double offset = i - 0.5 * (count - 1);
    weights.push_back(std::exp(-offset * offset / (2.0 * kSigma * kSigma)));
    sum += weights.back();
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

constexpr int kBlockRows = 64;
/// That of the sums over a window, as a multiple of a simple difference's.
constexpr size_t kCostOfPixel = 16;

/// Moments of both images: E[x], E[y], E[x^2], E[y^2], E[xy].
using Moments = std::array<double, 5>;

double similarity(const Moments& m) {
  const double meansSquared = m[0] * m[0] + m[1] * m[1], means = m[0] * m[1];
  const double variances = (m[2] - m[0] * m[0]) + (m[3] - m[1] * m[1]), covariance = m[4] - means;
  return (2.0 * means + kC1) * (2.0 * covariance + kC2) / ((meansSquared + kC1) * (variances + kC2));
}

MetricResult measure(const ComparisonInput& input, const NoMetricSettings&) {
  const Comparison pair(input, "ssim", Region::All);
  const int width = pair.width(), height = pair.height();
  const std::vector<double> acrossWeights = windowWeights(std::min(kWindow, width));
  const std::vector<double> downWeights = windowWeights(std::min(kWindow, height));
  const int across = static_cast<int>(acrossWeights.size()), down = static_cast<int>(downWeights.size());
  const int columns = width - across + 1, rows = height - down + 1;  // windows that fit

  std::vector<double> similarities(input.wantsMap ? static_cast<size_t>(columns) * rows : 0);
  std::vector<double> rowSums(static_cast<size_t>(rows));
  // In blocks of rows, whose moments stay in a core's cache.
  const int blocks = (rows + kBlockRows - 1) / kBlockRows;
  forEachRow(blocks, static_cast<size_t>(width) * kBlockRows * kCostOfPixel, [&](int block) {
    const int first = block * kBlockRows, last = std::min(first + kBlockRows, rows);
    std::vector<Moments> filtered(static_cast<size_t>(columns) * (last - first + down - 1));
    std::vector<double> test(static_cast<size_t>(width)), reference(test.size());
    for (int y = first; y < last + down - 1; ++y) {
      for (int x = 0; x < width; ++x) {
        test[static_cast<size_t>(x)] = encodeSrgb(relativeLuminance(pair.shownTest(x, y)));
        reference[static_cast<size_t>(x)] = encodeSrgb(relativeLuminance(pair.shownReference(x, y)));
      }
      for (int x = 0; x < columns; ++x) {
        Moments& sum = filtered[static_cast<size_t>(y - first) * columns + x] = {};
        for (int i = 0; i < across; ++i) {
          const double weight = acrossWeights[static_cast<size_t>(i)];
          const double t = test[static_cast<size_t>(x + i)], r = reference[static_cast<size_t>(x + i)];
          const Moments values = {t, r, t * t, r * r, t * r};
          for (size_t m = 0; m < values.size(); ++m) sum[m] += weight * values[m];
        }
      }
    }
    for (int y = first; y < last; ++y) {
      CompensatedSum row;
      for (int x = 0; x < columns; ++x) {
        Moments moments = {};
        for (int i = 0; i < down; ++i)
          for (size_t m = 0; m < moments.size(); ++m)
            moments[m] += downWeights[static_cast<size_t>(i)] *
                          filtered[static_cast<size_t>(y - first + i) * columns + x][m];
        const double value = similarity(moments);
        row.add(value);
        if (input.wantsMap) similarities[static_cast<size_t>(y) * columns + x] = value;
      }
      rowSums[static_cast<size_t>(y)] = row.value();
    }
  });
  CompensatedSum sum;
  for (const double row : rowSums) sum.add(row);

  MetricResult result;
  result.evaluatedPixels = pair.evaluatedPixels();
  result.value = sum.value() / (static_cast<double>(columns) * rows);
  if (!input.wantsMap) return result;
  // Each pixel shows the window centred on it, pixels near the border the nearest window.
  Image map(width, height, 1);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int column = std::clamp(x - across / 2, 0, columns - 1),
                row = std::clamp(y - down / 2, 0, rows - 1);
      map.at(x, y) = static_cast<float>(1.0 - similarities[static_cast<size_t>(row) * columns + column]);
    }
  result.map = std::move(map);
  result.mapName = "structural_dissimilarity";
  return result;
}

const RegisteredMetric<NoMetricSettings> kRegistered{
    {.name = "ssim",
     .summary = "mean structural similarity of the images' sRGB-coded luminance; 1 for equal images",
     .source = "Wang et al. 2004",
     .title = "Mean SSIM",
     .direction = Direction::HigherIsBetter},
    &measure};

}  // namespace
}  // namespace limen::perception
