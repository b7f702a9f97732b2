// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "analysis/statistics/interval.h"

namespace limen::analysis {

/// How well a score, such as a predictor's rating, separates yes (1) from no (0). Everything in this file
/// takes scores and outcomes of the same length; limen::Error names the index of a score that is not finite,
/// of an outcome that is neither 0 nor 1, and refuses lists without any 0 or without any 1.

struct RocPoint {
  double threshold = 0.0;  ///< scores at or above count as "yes"; +infinity for the first point
  double falseAlarmRate = 0.0, hitRate = 0.0;
};

/// From (0, 0) to (1, 1), one point per distinct score, by descending threshold.
std::vector<RocPoint> rocPoints(const std::vector<double>& scores, const std::vector<int>& outcomes);

/// Area under it = P(score of a yes > score of a no) + P(equal) / 2.
struct RocArea {
  size_t positives = 0, negatives = 0;
  double area = 0.0;
  /// DeLong, DeLong and Clarke-Pearson (1988), by midranks (Sun and Xu 2014); none with fewer than 2 of
  /// either outcome.
  std::optional<double> variance;
  /// Area +- z error, clipped to 0 .. 1; zero width for variance 0, which does not mean certainty.
  std::optional<Interval> interval;
  /// On the scale ln(A / (1 - A)), better next to 1 (Pepe 2003); none for an area of 0 or 1.
  std::optional<Interval> logitInterval;
};
RocArea rocArea(const std::vector<double>& scores, const std::vector<int>& outcomes, double level = 0.95);

/// Two scores of the same trials (DeLong, DeLong and Clarke-Pearson 1988).
struct RocComparison {
  RocArea first, second;
  double difference = 0.0;           ///< of the areas, first minus second
  std::optional<double> covariance;  ///< of the areas; none as above
  std::optional<Interval> interval;  ///< of the difference
  /// z = difference / error; none if the error vanishes or is unknown. p is then 1 if the areas are equal,
  /// otherwise none.
  std::optional<double> z, p;
};
RocComparison compareRocAreas(const std::vector<double>& first, const std::vector<double>& second,
                              const std::vector<int>& outcomes, double level = 0.95);

struct CalibrationBin {
  double low = 0.0, high = 0.0;  ///< of predictions; includes low, and high if it is 1
  int64_t trials = 0, positives = 0;
  double meanPrediction = 0.0;     ///< 0 without trials
  double observed = 0.0;           ///< share of outcomes 1; 0 without trials
  std::optional<Interval> wilson;  ///< of the share observed; none without trials
};

/// Do events predicted with probability q happen in a share q of cases?
struct Calibration {
  std::vector<CalibrationBin> bins;  ///< of equal width over 0 .. 1, including empty ones
  double brier = 0.0;                ///< mean squared difference of prediction and outcome (Brier 1950)
  /// Murphy (1973), over the bins, with the two terms needed if predictions differ within a bin
  /// (Stephenson, Coelho and Jolliffe 2008): brier = reliability - resolution + uncertainty + withinVariance
  /// - withinCovariance.
  double reliability = 0.0, resolution = 0.0, uncertainty = 0.0;
  double withinVariance = 0.0, withinCovariance = 0.0;
};

/// `probabilities` in 0 .. 1, limen::Error otherwise. Outcomes of one kind only are allowed here. 1 to 1000
/// bins.
Calibration calibrate(const std::vector<double>& probabilities, const std::vector<int>& outcomes,
                      size_t bins = 10, double level = 0.95);

}  // namespace limen::analysis
