// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace limen::perception {

/// Nearest-rank quantile: the smallest of the values that at least `share` of them do not exceed; 0 for none.
/// `values` is reordered.
double nearestRank(std::vector<double>& values, double share);

}  // namespace limen::perception
