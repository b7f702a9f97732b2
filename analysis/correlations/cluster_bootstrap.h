// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/output/result.h"
#include "analysis/statistics/interval.h"
#include "analysis/statistics/roc.h"

namespace limen::analysis {

struct BootstrapSetting {
  size_t samples = 2000;
  uint64_t seed = 1;
  double level = 0.95;
};

/// Fewer clusters than this say nothing on how clusters differ.
inline constexpr size_t kLeastClusters = 3;
/// With fewer than this, percentile intervals come out noticeably too narrow: they lack what Student's t and
/// n - 1 make up for. Scales of 100 simulated studies with 10 observers held the truth in 91 % of 95 %
/// intervals.
inline constexpr size_t kFewClusters = 20;

struct ResampledInterval {
  /// Percentile interval (Efron and Tibshirani 1993, chapter 13); none with too few clusters, or if the
  /// statistic was undefined in more than half of the samples.
  std::optional<Interval> interval;
  size_t undefined = 0;  ///< samples without the statistic, which the interval leaves out
};

/// Statistics of the rows that are named, each once or more, in the order of the intervals asked for.
using RowStatistics = std::function<std::vector<std::optional<double>>(const std::vector<size_t>& rows)>;

/// Draws whole clusters of rows with replacement, as many as there are: rows of one cluster, such as the
/// trials of one participant, are not independent of each other (Davison and Hinkley 1997, section 3.8).
/// `clusters` has the number of each row's, from 0 without gaps. Same seed, same bytes.
std::vector<ResampledInterval> resampleClusters(const std::vector<size_t>& clusters, size_t statistics,
                                                const RowStatistics& of, const BootstrapSetting& setting);

/// The interval that resampled values of a statistic leave; `values` may be empty.
ResampledInterval percentileInterval(const std::vector<double>& values, const BootstrapSetting& setting);

/// What is to be said of a bootstrap over so many clusters; empty if they are enough.
std::string noteOnClusters(size_t count, const std::string& of);

std::string levelText(double level);  ///< "95 %"
/// level, bootstrap_over, samples, seed; the last three only where rows were resampled.
void addBootstrapFacts(Section& out, const std::string& over, const BootstrapSetting& setting);
/// What is to be said of intervals of a bootstrap over clusters; "" for none.
std::string bootstrapNote(const std::string& cluster);
/// Interval of a bootstrap, if there is one.
std::optional<Interval> boundsOf(const std::optional<ResampledInterval>& bootstrap);

inline constexpr const char* kDashNote = "-: cannot be told, or of no width, which is no certainty";

/// Tables "calibration", the terms of the Brier score, and "bins", of probabilities in column `x`.
void addCalibration(Section& out, const Calibration& calibration, const std::string& x,
                    const std::string& level);

}  // namespace limen::analysis
