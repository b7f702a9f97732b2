// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/correlations/cluster_bootstrap.h"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/statistics/summary.h"
#include "perception/psychometrics/random.h"

namespace limen::analysis {

ResampledInterval percentileInterval(const std::vector<double>& values, const BootstrapSetting& setting) {
  ResampledInterval out;
  out.undefined = setting.samples - values.size();
  if (values.empty() || 2 * out.undefined > setting.samples) return out;
  const double tail = (1.0 - setting.level) / 2.0;
  out.interval = Interval{quantile(values, tail), quantile(values, 1.0 - tail)};
  return out;
}

std::vector<ResampledInterval> resampleClusters(const std::vector<size_t>& clusters, size_t statistics,
                                                const RowStatistics& of, const BootstrapSetting& setting) {
  std::vector<std::vector<size_t>> rowsOf;
  for (size_t row = 0; row < clusters.size(); ++row) {
    rowsOf.resize(std::max(rowsOf.size(), clusters[row] + 1));
    rowsOf[clusters[row]].push_back(row);
  }
  std::vector<ResampledInterval> out(statistics);
  if (rowsOf.size() < kLeastClusters) return out;
  psychometrics::Random random(setting.seed);
  std::vector<std::vector<double>> values(statistics);
  std::vector<size_t> rows;
  for (size_t sample = 0; sample < setting.samples; ++sample) {
    rows.clear();
    for (size_t i = 0; i < rowsOf.size(); ++i) {
      const std::vector<size_t>& drawn = rowsOf[random.below(rowsOf.size())];
      rows.insert(rows.end(), drawn.begin(), drawn.end());
    }
    const std::vector<std::optional<double>> found = of(rows);
    for (size_t i = 0; i < statistics; ++i)
      if (found[i]) values[i].push_back(*found[i]);
  }
  for (size_t i = 0; i < statistics; ++i) out[i] = percentileInterval(values[i], setting);
  return out;
}

std::string noteOnClusters(size_t count, const std::string& of) {
  if (count < kLeastClusters)
    return fmt::format("{} different {}: no bootstrap, which takes {}", count, of, kLeastClusters);
  if (count < kFewClusters)
    return fmt::format("{} different {} are few: intervals of the bootstrap come out somewhat too narrow",
                       count, of);
  return {};
}

}  // namespace limen::analysis
