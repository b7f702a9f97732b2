// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace limen::analysis {

/// Indices of the points that no other point beats: smaller is better in both, in order of growing first
/// value. Of equal points all stay.
std::vector<size_t> paretoFront(const std::vector<std::pair<double, double>>& points);

/// Round numbers to cut a range of errors at: powers of ten (and their triples) where the range is wide,
/// steps of 1, 2 or 5 where it is narrow or `logarithmic` is false. Ascending, within [low, high], five at
/// most.
std::vector<double> roundLevels(double low, double high, bool logarithmic);

}  // namespace limen::analysis
