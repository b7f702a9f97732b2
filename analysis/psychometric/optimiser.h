// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "analysis/psychometric/objective.h"

namespace limen::analysis {

struct Optimum {
  std::vector<double> x;
  double value = 0.0;
  std::vector<int> atBound;  ///< of each parameter: -1 at its lower bound, 1 at the upper, 0 between
};

/// The minimum within the bounds that is reached from `start`: BFGS with a line search by Ceres, on angles
/// that represent the bounded parameters (x = low + (high - low) sin^2 a), then Newton steps for those that
/// are not at a bound. Parameters with held[j] stay where they start.
Optimum minimise(const Objective& objective, const std::vector<double>& start,
                 const std::vector<bool>& held = {});

/// Second derivatives at x, row by row, by central differences of the exact gradient (one-sided near bounds).
std::vector<double> secondDerivatives(const Objective& objective, const std::vector<double>& x);

/// Points from which the optimum of a single condition is sought, the best of a coarse grid that are not near
/// each other; at most `count`. The grid's thresholds are evenly spaced and, for each width, those at which
/// the curve runs through one of the blocks: narrow curves have an optimum at each.
std::vector<std::vector<double>> startsOf(const Objective& objective, size_t count);

}  // namespace limen::analysis
