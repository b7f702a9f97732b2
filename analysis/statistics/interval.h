// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace limen::analysis {

/// Bounds of a confidence interval; which level and which method it has, says whoever returns it.
struct Interval {
  double low = 0.0, high = 0.0;
};

}  // namespace limen::analysis
