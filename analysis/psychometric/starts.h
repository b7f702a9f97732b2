// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "analysis/psychometric/objective.h"

namespace limen::analysis {

/// Points from which the optimum of a single condition is sought, the best of a coarse grid that are not near
/// each other; at most `count`. The grid's thresholds are evenly spaced and, for each width, those at which
/// the curve runs through one of the blocks: narrow curves have an optimum at each.
std::vector<std::vector<double>> startsOf(const Objective& objective, size_t count);

}  // namespace limen::analysis
