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

std::string levelText(double level) { return fmt::format("{:.4g} %", 100.0 * level); }

void addBootstrapFacts(Section& out, const std::string& over, const BootstrapSetting& setting) {
  out.fact(forData(number("level")), setting.level);
  if (over.empty()) return;
  out.fact(text("bootstrap_over"), over);
  out.fact(integer("samples"), setting.samples);
  out.fact(integer("seed"), setting.seed);
}

std::string bootstrapNote(const std::string& cluster) {
  if (cluster.empty()) return {};
  return "bootstrap: percentile intervals; rows that are alike in '" + cluster +
         "' are drawn together. Where there are several such rows, these are the intervals to report: the "
         "others, and p, are too sure";
}

std::optional<Interval> boundsOf(const std::optional<ResampledInterval>& bootstrap) {
  return bootstrap ? bootstrap->interval : std::nullopt;
}

void addCalibration(Section& out, const Calibration& calibration, const std::string& x,
                    const std::string& level) {
  const std::vector<Calibration> whole = {calibration};
  out.add(
      TableOf(
          "calibration",
          "calibration of " + x +
              ": Brier score = reliability - resolution + uncertainty + within bins (variance - covariance)",
          whole)
          .add(text("x"), [&](const Calibration&) { return x; })
          .add(number("brier", "Brier", 4), &Calibration::brier)
          .add(number("reliability", "", 4), &Calibration::reliability)
          .add(number("resolution", "", 4), &Calibration::resolution)
          .add(number("uncertainty", "", 4), &Calibration::uncertainty)
          .add(number("within_variance", "", 4), &Calibration::withinVariance)
          .add(number("within_covariance", "", 4), &Calibration::withinCovariance));
  const auto ifShown = [](auto member) { return when(&CalibrationBin::trials, member); };
  const Column predicted = interval("bin", "predicted", 2);
  out.add(TableOf("bins", "what was observed where " + x + " was predicted", calibration.bins)
              .add(forData(text("x")), [&](const CalibrationBin&) { return x; })
              .add(predicted,
                   [](const CalibrationBin& bin) {
                     return Interval{bin.low, bin.high};
                   })
              .add(count("positives", "trials", "1 of"),
                   countOf(&CalibrationBin::positives, &CalibrationBin::trials))
              .add(number("mean_prediction", "mean"), ifShown(&CalibrationBin::meanPrediction))
              .add(number("estimate", "observed"), ifShown(&CalibrationBin::observed))
              .add(interval("", level + " (Wilson)"), &CalibrationBin::wilson));
}

}  // namespace limen::analysis
