// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "experiments/base/error.h"
#include "perception/metrics/metric.h"
#include "perception/metrics/row_sums.h"

namespace limen::perception {
namespace {

MetricResult countNonFinite(const ComparisonInput& input, const NoMetricSettings&) {
  if (!input.test) throw Error("metric 'non_finite' has no test image");
  const Image& test = *input.test;
  const size_t perRow = static_cast<size_t>(test.width) * static_cast<size_t>(test.channels);
  MetricResult result;
  result.value = sumRows(test.height, perRow, [&](int y) {
    const float* row = test.data.data() + static_cast<size_t>(y) * perRow;
    double bad = 0.0;
    for (size_t i = 0; i < perRow; ++i) bad += std::isfinite(row[i]) ? 0.0 : 1.0;
    return bad;
  });
  result.evaluatedPixels = static_cast<int64_t>(test.pixels());
  return result;
}

const RegisteredMetric<NoMetricSettings> kRegistered{
    {.name = "non_finite",
     .summary = "count of values (all channels) that are infinite or not a number",
     .title = "Non-finite values",
     .needsReference = false},
    &countNonFinite};

}  // namespace
}  // namespace limen::perception
