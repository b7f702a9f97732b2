// SPDX-License-Identifier: BSD-3-Clause
// Errors of positive quantities that span decades, such as thresholds: relative_error, its percentile and
// mean, flipped decisions, and the visibility of a pyramid's grid.
#include <algorithm>
#include <cmath>
#include <vector>

#include "perception/metrics/comparison.h"
#include "perception/metrics/quantile.h"
#include "perception/metrics/row_sums.h"
#include "perception/multiscale/pyramid.h"

namespace limen::perception {
namespace {

/// |test - reference| / max(|reference|, least) of each evaluated pixel, worst channel; non-finite test
/// values count as 1. If that divisor is 0 the error itself counts.
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
  out.reserve(static_cast<size_t>(pair.evaluatedPixels()));
  for (int y = 0; y < pair.height(); ++y)
    for (int x = 0; x < pair.width(); ++x)
      if (pair.evaluates(x, y)) out.push_back(relativeError(pair, x, y, least));
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

struct RelativeErrorSettings {
  ComparedRegion region;
  double leastReference = 0.0;
  static const SettingsTable<RelativeErrorSettings>& table() {
    static const SettingsTable<RelativeErrorSettings> kTable = {
        included(&RelativeErrorSettings::region),
        {&RelativeErrorSettings::leastReference,
         "least_reference",
         {0.0, 1e6},
         "product's unit",
         "a smaller reference counts as this: below it, the error is relative to this value"}};
    return kTable;
  }
};

RegisteredMetric<RelativeErrorSettings> relativeMetric(MetricInfo info,
                                                       double (*pool)(std::vector<double>&)) {
  const std::string name = info.name;
  return {std::move(info), [name, pool](const ComparisonInput& input, const RelativeErrorSettings& settings) {
            const Comparison pair(input, name, settings.region.region);
            const double least = settings.leastReference;
            std::vector<double> errors = relativeErrors(pair, least);
            MetricResult result;
            result.value = pool(errors);
            result.evaluatedPixels = pair.evaluatedPixels();
            Image map(pair.width(), pair.height(), 1);
            for (int y = 0; y < pair.height(); ++y)
              for (int x = 0; x < pair.width(); ++x)
                if (pair.evaluates(x, y)) map.at(x, y) = static_cast<float>(relativeError(pair, x, y, least));
            result.map = std::move(map);
            result.mapName = "relative_error";
            return result;
          }};
}

struct FlipSettings {
  ComparedRegion region;
  double differenceCdM2 = 1.0;  ///< the same at all pixels
  static const SettingsTable<FlipSettings>& table() {
    static const SettingsTable<FlipSettings> kTable = {included(&FlipSettings::region),
                                                       {&FlipSettings::differenceCdM2,
                                                        "difference_cd_m2",
                                                        {0.0, 1e5},
                                                        "cd/m2",
                                                        "the difference, the same at all pixels"}};
    return kTable;
  }
};

MetricResult countFlips(const ComparisonInput& input, const FlipSettings& settings) {
  const Comparison pair(input, "decision_flips", settings.region.region);
  if (pair.channels() != 1)
    throw Error("metric 'decision_flips' compares threshold maps, not colour", {},
                "remove it for techniques whose product is a colour image");
  const double difference = settings.differenceCdM2;
  MetricResult result;
  result.evaluatedPixels = pair.evaluatedPixels();
  const double flips = sumRows(pair.height(), static_cast<size_t>(pair.width()), [&](int y) {
    double count = 0.0;
    for (int x = 0; x < pair.width(); ++x)
      if (pair.evaluates(x, y))
        count += (difference > pair.test().at(x, y)) != (difference > pair.reference().at(x, y)) ? 1.0 : 0.0;
    return count;
  });
  if (result.evaluatedPixels > 0) result.value = flips / static_cast<double>(result.evaluatedPixels);
  return result;
}

struct BlockSettings {
  int level = 3;  ///< of a pyramid; its texels span 2^level pixels
  static const SettingsTable<BlockSettings>& table() {
    static const SettingsTable<BlockSettings> kTable = {
        {&BlockSettings::level, "level", {1, 8}, "", "pyramid level; its texels span 2^level pixels"}};
    return kTable;
  }
};

MetricResult measureBlocks(const ComparisonInput& input, const BlockSettings& settings) {
  if (!input.test) throw Error("metric 'block_artifacts' has no test image");
  const Image& test = *input.test;
  Plane plane(test.width, test.height);
  for (size_t i = 0; i < plane.data.size(); ++i) {
    const float value = test.data[i * static_cast<size_t>(test.channels)];
    plane.data[i] = std::isfinite(value) ? value : 0.0;
  }
  MetricResult result;
  result.value = blockMetric(plane, settings.level).medianRatio();
  result.evaluatedPixels = static_cast<int64_t>(test.pixels());
  return result;
}

const auto kLargest = relativeMetric({.name = "relative_error",
                                      .summary = "largest relative error of a pixel",
                                      .title = "Largest relative error"},
                                     &largestOf);
const auto kPercentile =
    relativeMetric({.name = "p99_relative_error",
                    .summary = "99th percentile (nearest rank) of the pixels' relative errors",
                    .title = "99th percentile of the relative error"},
                   &percentileOf);
const auto kMean = relativeMetric({.name = "mean_relative_error",
                                   .summary = "mean of the pixels' relative errors",
                                   .title = "Mean relative error"},
                                  &meanOf);
const RegisteredMetric<FlipSettings> kFlips{{.name = "decision_flips",
                                             .summary = "share of pixels where a luminance difference is "
                                                        "above one threshold map but not above the other",
                                             .source = "Schwarz 2009, section 9.2",
                                             .title = "Share of pixels with flipped decisions"},
                                            &countFlips};
const RegisteredMetric<BlockSettings> kBlocks{
    {.name = "block_artifacts",
     .summary = "median second difference on the grid of a pyramid level, relative to that beside it (first "
                "channel); 1: no grid. For sizes that are multiples of 2^level",
     .source = "Schwarz 2009, section 9.4, figure 9.6",
     .title = "Visibility of the pyramid's grid",
     .needsReference = false},
    &measureBlocks};

}  // namespace
}  // namespace limen::perception
