// SPDX-License-Identifier: BSD-3-Clause
// Errors of quantities that are positive and span decades, such as thresholds: relative_error, its percentile
// and mean, decisions that flip, and how visible a pyramid's grid is.
#include <algorithm>
#include <cmath>
#include <vector>

#include "perception/metrics/comparison.h"
#include "perception/metrics/quantile.h"
#include "perception/metrics/row_sums.h"
#include "perception/multiscale/pyramid.h"

namespace limen::perception {
namespace {

/// |test - reference| / max(|reference|, least) of each judged pixel, worst channel; non-finite test values
/// count as 1. Where that divisor is 0 the error itself counts.
double relativeError(const Comparison& pair, int x, int y, double least) {
  double largest = 0.0;
  for (int c = 0; c < pair.channels(); ++c) {
    const double reference = std::max(std::abs(double{pair.reference().at(x, y, c)}), least);
    const bool finite = std::isfinite(pair.test().at(x, y, c));
    const double error = std::abs(pair.error(x, y, c));
    largest = std::max(largest, finite && reference > 0.0 ? error / reference : error);
  }
  return largest;
}

std::vector<double> relativeErrors(const Comparison& pair, double least) {
  std::vector<double> out;
  out.reserve(static_cast<size_t>(pair.judgedPixels()));
  for (int y = 0; y < pair.height(); ++y)
    for (int x = 0; x < pair.width(); ++x)
      if (pair.judges(x, y)) out.push_back(relativeError(pair, x, y, least));
  return out;
}

double largestOf(std::vector<double>& errors) {
  return errors.empty() ? 0.0 : *std::max_element(errors.begin(), errors.end());
}
double percentileOf(std::vector<double>& errors) { return nearestRank(errors, 0.99); }
double meanOf(std::vector<double>& errors) {
  CompensatedSum sum;
  for (const double error : errors) sum.add(error);
  return errors.empty() ? 0.0 : sum.value() / static_cast<double>(errors.size());
}

MetricInfo relativeMetric(const std::string& name, const std::string& summary,
                          double (*pool)(std::vector<double>&)) {
  MetricInfo info;
  info.name = name;
  info.summary = summary;
  info.parameters = {regionParameter(),
                     realParameter("least_reference", 0.0, 0.0, 1e6, "product's unit",
                                   "a smaller reference counts as this: below, the error is in its shares")};
  info.compare = [name, pool](const ComparisonInput& input, const ParameterValues& values) {
    const Comparison pair(input, name, regionOf(values));
    const double least = values.real("least_reference");
    std::vector<double> errors = relativeErrors(pair, least);
    MetricResult result;
    result.value = pool(errors);
    result.judgedPixels = pair.judgedPixels();
    Image map(pair.width(), pair.height(), 1);
    for (int y = 0; y < pair.height(); ++y)
      for (int x = 0; x < pair.width(); ++x)
        if (pair.judges(x, y)) map.at(x, y) = static_cast<float>(relativeError(pair, x, y, least));
    result.map = std::move(map);
    result.mapName = "relative_error";
    return result;
  };
  return info;
}

MetricResult countFlips(const ComparisonInput& input, const ParameterValues& values) {
  const Comparison pair(input, "decision_flips", regionOf(values));
  if (pair.channels() != 1)
    throw Error("metric 'decision_flips' judges threshold maps, not colour", {},
                "remove it for techniques whose product is a colour image");
  const double difference = values.real("difference_cd_m2");
  MetricResult result;
  result.judgedPixels = pair.judgedPixels();
  const double flips = sumRows(pair.height(), static_cast<size_t>(pair.width()), [&](int y) {
    double count = 0.0;
    for (int x = 0; x < pair.width(); ++x)
      if (pair.judges(x, y))
        count += (difference > pair.test().at(x, y)) != (difference > pair.reference().at(x, y)) ? 1.0 : 0.0;
    return count;
  });
  if (result.judgedPixels > 0) result.value = flips / static_cast<double>(result.judgedPixels);
  return result;
}

MetricResult measureBlocks(const ComparisonInput& input, const ParameterValues& values) {
  if (!input.test) throw Error("metric 'block_artifacts' has no test image");
  const Image& test = *input.test;
  Plane plane(test.width, test.height);
  for (size_t i = 0; i < plane.data.size(); ++i) {
    const float value = test.data[i * static_cast<size_t>(test.channels)];
    plane.data[i] = std::isfinite(value) ? value : 0.0;
  }
  MetricResult result;
  result.value = blockMetric(plane, static_cast<int>(values.integer("level"))).medianRatio();
  result.judgedPixels = static_cast<int64_t>(test.pixels());
  return result;
}

MetricInfo flipsMetric() {
  MetricInfo info;
  info.name = "decision_flips";
  info.summary =
      "share of pixels where a luminance difference is above the one threshold map and not above the other";
  info.source = "Schwarz 2009, section 9.2";
  info.parameters = {regionParameter(), realParameter("difference_cd_m2", 1.0, 0.0, 1e5, "cd/m2",
                                                      "the difference, the same at all pixels")};
  info.compare = &countFlips;
  return info;
}

MetricInfo blocksMetric() {
  MetricInfo info;
  info.name = "block_artifacts";
  info.summary =
      "median second difference on the grid of a pyramid level over that beside it (first channel); 1: no "
      "grid. For sizes that are multiples of 2^level";
  info.source = "Schwarz 2009, section 9.4, figure 9.6";
  info.needsReference = false;
  info.parameters = {integerParameter("level", 3, 1, 8, "", "pyramid level; its texels span 2^level pixels")};
  info.compare = &measureBlocks;
  return info;
}

const Registered<MetricInfo> kLargest{
    relativeMetric("relative_error", "largest relative error of a pixel", &largestOf)};
const Registered<MetricInfo> kPercentile{relativeMetric(
    "p99_relative_error", "99th percentile (nearest rank) of the pixels' relative errors", &percentileOf)};
const Registered<MetricInfo> kMean{
    relativeMetric("mean_relative_error", "mean of the pixels' relative errors", &meanOf)};
const Registered<MetricInfo> kFlips{flipsMetric()};
const Registered<MetricInfo> kBlocks{blocksMetric()};

}  // namespace
}  // namespace limen::perception
