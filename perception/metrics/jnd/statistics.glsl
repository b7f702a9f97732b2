// SPDX-License-Identifier: BSD-3-Clause
// What the kernels that find percentiles share.
#include "perception/metrics/jnd/jnd_bindings.h"

layout(binding = kStatisticsBuffer, std430) buffer Statistics {
  JndStatistics statistics;
  uint histogram[kJndBins];
};
// Values are found from their highest bits down: 11, then 10, then 10. Positive floats are in the order of their bits.
uniform int round_;  // 0, 1, 2
