// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace limen::analysis {

/// Bounds of a confidence interval; level and method are documented where it is returned.
struct Interval {
  double low = 0.0, high = 0.0;
};
inline Interval around(double middle, double reach) { return {middle - reach, middle + reach}; }

}  // namespace limen::analysis
