// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace limen::analysis {

/// Least-squares fit of a sequence that never rises, by pooling adjacent violators (Ayer, Brunk, Ewing, Reid
/// and Silverman 1955); all weights are equal.
std::vector<double> fitNonIncreasing(const std::vector<double>& values);

/// Where a falling curve comes down to a level, or on which side of the measured range that lies.
struct Crossing {
  enum class Place { Within, AtOrBelowFirst, BeyondLast };
  Place place = Place::Within;
  double x = 0.0;  ///< of the crossing; of the first or last point if it is not within
};

/// First x at which the non-increasing fit of `y` is at or below `level`; between two points the curve is
/// linear in lg x. `x` is positive and ascends; both have the same length, at least 1.
Crossing findCrossing(const std::vector<double>& x, const std::vector<double>& y, double level);

/// Crossings compare by where they lie on the axis.
bool operator<(const Crossing& a, const Crossing& b);

struct CrossingEstimate {
  Crossing ofMean;                    ///< of the mean over the replicates
  Crossing farthest;                  ///< of the replicate that crosses last
  std::optional<Crossing> low, high;  ///< percentile bootstrap over the replicates; none for a single one
};

/// `replicates` holds one curve each over the same `x`. The interval resamples whole curves, `resamples`
/// times: points of one curve are not independent. Same seed, same bytes.
CrossingEstimate estimateCrossing(const std::vector<double>& x,
                                  const std::vector<std::vector<double>>& replicates, double level,
                                  double confidence = 0.95, int resamples = 2000, uint64_t seed = 1);

}  // namespace limen::analysis
