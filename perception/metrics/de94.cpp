// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <vector>

#include "perception/metrics/comparison.h"
#include "perception/metrics/quantile.h"
#include "perception/metrics/row_sums.h"
#include "perception/vision/colour.h"

namespace limen::perception {
namespace {

/// How the pixels' values are pooled.
enum class Statistic { Mean, Max, P99 };
constexpr EnumNames<Statistic, 3> enumNames(Statistic) {
  return {{{{Statistic::Mean, "mean"}, {Statistic::Max, "max"}, {Statistic::P99, "p99"}}}};
}

struct De94Settings {
  Statistic statistic = Statistic::Mean;
  ComparedRegion region;
  static const SettingsTable<De94Settings>& table() {
    static const SettingsTable<De94Settings> kTable = {
        {&De94Settings::statistic, "statistic", "how the pixels' values are pooled"},
        included(&De94Settings::region)};
    return kTable;
  }
};

MetricResult measure(const ComparisonInput& input, const De94Settings& settings) {
  const Comparison pair(input, "de94", settings.region.region);
  MetricResult result;
  result.evaluatedPixels = pair.evaluatedPixels();
  std::vector<double> differences(pair.test().pixels());
  const auto index = [&](int x, int y) { return static_cast<size_t>(y) * pair.width() + x; };
  Image map(pair.width(), pair.height(), 1);
  const double sum = sumRows(pair.height(), static_cast<size_t>(pair.width()), [&](int y) {
    CompensatedSum row;
    for (int x = 0; x < pair.width(); ++x) {
      if (!pair.evaluates(x, y)) continue;
      const double difference = differenceCie94(labFromLinearRgb(pair.shownReference(x, y)),
                                                labFromLinearRgb(pair.shownTest(x, y)));
      differences[index(x, y)] = difference;
      map.at(x, y) = static_cast<float>(difference);
      row.add(difference);
    }
    return row.value();
  });
  if (result.evaluatedPixels > 0) {
    if (settings.statistic == Statistic::Mean) {
      result.value = sum / static_cast<double>(result.evaluatedPixels);
    } else if (settings.statistic == Statistic::Max) {
      result.value = *std::max_element(differences.begin(), differences.end());
    } else {
      std::vector<double> evaluated;
      evaluated.reserve(static_cast<size_t>(result.evaluatedPixels));
      for (int y = 0; y < pair.height(); ++y)
        for (int x = 0; x < pair.width(); ++x)
          if (pair.evaluates(x, y)) evaluated.push_back(differences[index(x, y)]);
      result.value = nearestRank(evaluated, 0.99);
    }
  }
  result.map = std::move(map);
  result.mapName = "de94";
  return result;
}

const RegisteredMetric<De94Settings> kRegistered{
    {.name = "de94",
     .summary = "CIELAB difference CIE94 (graphic arts) of the images as an sRGB display shows them",
     .source = "CIE 116-1995",
     .title = "CIE94 colour difference",
     .unit = "dE94"},
    &measure};

}  // namespace
}  // namespace limen::perception
