// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "analysis/statistics/interval.h"

namespace limen::analysis {

/// How often something was noticed: `successes` of `trials`.
struct Rate {
  int64_t successes = 0, trials = 0;
  double rate = 0.0;        ///< successes / trials
  Interval wilson;          ///< score interval (Wilson 1927), without continuity correction
  Interval clopperPearson;  ///< exact interval (Clopper and Pearson 1934), never too short
};

/// limen::Error if a count is negative, successes exceed trials, or there are no trials.
Rate detectionRate(int64_t successes, int64_t trials, double level = 0.95);

/// (p + z^2/2n +- z sqrt(p(1-p)/n + z^2/4n^2)) / (1 + z^2/n); bounds are exactly 0 and 1 for no successes and
/// for all.
Interval wilsonInterval(int64_t successes, int64_t trials, double level = 0.95);
/// Quantiles alpha/2 and 1 - alpha/2 of Beta(k, n-k+1) and Beta(k+1, n-k).
Interval clopperPearsonInterval(int64_t successes, int64_t trials, double level = 0.95);

/// Mean of one value per subject, such as each subject's detection rate. Trials of one subject are not
/// independent, so an interval over subjects is wider than one over the pooled trials, and is the one to
/// report.
struct MeanOverSubjects {
  size_t subjects = 0;
  double mean = 0.0;
  /// With n - 1; none for one subject. The interval is mean +- t_(n-1) sd / sqrt(n) (Student 1908), not
  /// clipped to the range of a rate.
  std::optional<double> standardDeviation, standardError;
  std::optional<Interval> interval;
};

/// limen::Error without values, or if one is not finite.
MeanOverSubjects meanOverSubjects(const std::vector<double>& values, double level = 0.95);

/// mean +- critical error on the logit scale; 0 < mean < 1.
Interval logitInterval(double mean, double error, double critical);

/// The same of rates, with an interval that stays between 0 and 1: mean +- t_(n-1) error on the logit scale,
/// the error carried over by the slope there, error / (m (1 - m)). It is the logit interval of proportions of
/// clusters in surveys (Korn and Graubard 1998, Survey Methodology 24; svyciprop(method = "logit") of R's
/// package survey), with observers as clusters. None where all are 0 or all 1. limen::Error for a value
/// outside of 0 to 1.
MeanOverSubjects meanRateOverSubjects(const std::vector<double>& rates, double level = 0.95);

}  // namespace limen::analysis
