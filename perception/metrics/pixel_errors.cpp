// SPDX-License-Identifier: BSD-3-Clause
// Errors pixel by pixel: rmse, mae, largest_error, signed_error, p99_error and psnr. Means run over pixels
// and colour channels; a pixel's own error, for figures per pixel (largest, p99, map), is that of its worst
// channel.
#include <algorithm>
#include <cmath>
#include <vector>

#include "perception/metrics/comparison.h"
#include "perception/metrics/quantile.h"
#include "perception/metrics/row_sums.h"

namespace limen::perception {
namespace {

/// Equal images have no finite PSNR; they get this value, as does any error below 1e-10.
constexpr double kPsnrCapDb = 200.0;

/// Mean of function(error) over evaluated pixels and channels; 0 for an empty region.
template <class Function>
double meanOverErrors(const Comparison& pair, Function function) {
  if (pair.evaluatedPixels() == 0) return 0.0;
  const double sum = sumRows(pair.height(), static_cast<size_t>(pair.width()), [&](int y) {
    CompensatedSum row;
    for (int x = 0; x < pair.width(); ++x) {
      if (!pair.evaluates(x, y)) continue;
      for (int c = 0; c < pair.channels(); ++c) row.add(function(pair.error(x, y, c)));
    }
    return row.value();
  });
  return sum / (static_cast<double>(pair.evaluatedPixels()) * pair.channels());
}

double pixelError(const Comparison& pair, int x, int y) {
  double largest = 0.0;
  for (int c = 0; c < pair.channels(); ++c) largest = std::max(largest, std::abs(pair.error(x, y, c)));
  return largest;
}

std::vector<double> evaluatedErrors(const Comparison& pair) {
  std::vector<std::vector<double>> rows(static_cast<size_t>(pair.height()));
  forEachRow(pair.height(), static_cast<size_t>(pair.width()), [&](int y) {
    std::vector<double>& row = rows[static_cast<size_t>(y)];
    row.reserve(static_cast<size_t>(pair.width()));
    for (int x = 0; x < pair.width(); ++x)
      if (pair.evaluates(x, y)) row.push_back(pixelError(pair, x, y));
  });
  std::vector<double> errors;
  errors.reserve(static_cast<size_t>(pair.evaluatedPixels()));
  for (const std::vector<double>& row : rows) errors.insert(errors.end(), row.begin(), row.end());
  return errors;
}

Image absoluteErrorMap(const Comparison& pair) {
  Image map(pair.width(), pair.height(), 1);
  forEachRow(pair.height(), static_cast<size_t>(pair.width()), [&](int y) {
    for (int x = 0; x < pair.width(); ++x)
      if (pair.evaluates(x, y)) map.at(x, y) = static_cast<float>(pixelError(pair, x, y));
  });
  return map;
}

double rootMeanSquare(const Comparison& pair) {
  return std::sqrt(meanOverErrors(pair, [](double error) { return error * error; }));
}

double meanAbsolute(const Comparison& pair) {
  return meanOverErrors(pair, [](double error) { return std::abs(error); });
}

double meanSigned(const Comparison& pair) {
  return meanOverErrors(pair, [](double error) { return error; });
}

double largest(const Comparison& pair) {
  std::vector<double> rows(static_cast<size_t>(pair.height()));
  forEachRow(pair.height(), static_cast<size_t>(pair.width()), [&](int y) {
    double& most = rows[static_cast<size_t>(y)];
    for (int x = 0; x < pair.width(); ++x)
      if (pair.evaluates(x, y)) most = std::max(most, pixelError(pair, x, y));
  });
  return rows.empty() ? 0.0 : *std::max_element(rows.begin(), rows.end());
}

double percentile99(const Comparison& pair) {
  std::vector<double> errors = evaluatedErrors(pair);
  return nearestRank(errors, 0.99);
}

double peakSignalToNoise(const Comparison& pair) {
  const double rms = rootMeanSquare(pair);
  return rms > 0.0 ? std::min(kPsnrCapDb, -20.0 * std::log10(rms)) : kPsnrCapDb;
}

RegisteredMetric<ComparedRegion> pixelMetric(MetricInfo info, double (*measure)(const Comparison&),
                                             bool withMap) {
  const std::string name = info.name;
  return {std::move(info), [name, measure, withMap](const ComparisonInput& input, const ComparedRegion& s) {
            const Comparison pair(input, name, s.region);
            MetricResult result;
            result.value = measure(pair);
            result.evaluatedPixels = pair.evaluatedPixels();
            if (withMap && input.wantsMap) {
              result.map = absoluteErrorMap(pair);
              result.mapName = "absolute_error";
            }
            return result;
          }};
}

const auto kRmse = pixelMetric(
    {.name = "rmse", .summary = "root mean square error", .title = "RMSE", .averagesPixels = true},
    &rootMeanSquare, true);
const auto kMae = pixelMetric(
    {.name = "mae", .summary = "mean absolute error", .title = "Mean absolute error", .averagesPixels = true},
    &meanAbsolute, true);
const auto kSigned =
    pixelMetric({.name = "signed_error",
                 .summary = "mean of test minus reference; below 0: the test is too dark (over-shadowed)",
                 .title = "Mean signed error",
                 .direction = Direction::Neither},
                &meanSigned, false);
const auto kLargest = pixelMetric(
    {.name = "largest_error", .summary = "largest absolute error", .title = "Largest error"}, &largest, true);
const auto kPercentile =
    pixelMetric({.name = "p99_error",
                 .summary = "99th percentile (nearest rank) of the pixels' absolute errors",
                 .title = "99th percentile of the error"},
                &percentile99, true);
const auto kPsnr = pixelMetric(
    {.name = "psnr",
     .summary = "peak signal-to-noise ratio for a peak of 1; at most 200 dB, which equal images get",
     .title = "PSNR",
     .unit = "dB",
     .direction = Direction::HigherIsBetter},
    &peakSignalToNoise, false);

}  // namespace
}  // namespace limen::perception
