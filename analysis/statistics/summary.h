// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace limen::analysis {

struct Summary {
  size_t n = 0;
  double minimum = 0.0, median = 0.0, mean = 0.0, p95 = 0.0;
  double standardDeviation = 0.0;  ///< with n - 1; 0 for a single value
};

/// Quantile by linear interpolation between order statistics: position q (n - 1), counted from 0 (Hyndman and
/// Fan 1996, type 7; the default of R and NumPy). `values` is not empty.
double quantile(std::vector<double> values, double q);
/// The same of values that are sorted.
double sortedQuantile(const std::vector<double>& sorted, double q);

/// `values` is not empty.
Summary summarise(const std::vector<double>& values);

struct MedianInterval {
  double low = 0.0, high = 0.0;
  bool byRounds = false;  ///< whole rounds were resampled, not single frames
};

/// 95 % percentile bootstrap interval of the median (Efron and Tibshirani 1993, chapter 13), 2000 resamples.
/// `rounds` names the round of each value. With three or more rounds these are drawn as blocks: frames of one
/// round share the clock and the temperature of the machine, so single frames would give intervals that are
/// too narrow. Same seed, same bytes.
MedianInterval bootstrapMedian(const std::vector<double>& values, const std::vector<int>& rounds,
                               uint64_t seed = 1);

}  // namespace limen::analysis
