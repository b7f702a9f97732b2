// SPDX-License-Identifier: BSD-3-Clause
#include "perception/metrics/quantile.h"

#include <algorithm>
#include <cmath>

namespace limen::perception {

double nearestRank(std::vector<double>& values, double share) {
  if (values.empty()) return 0.0;
  const auto rank = static_cast<size_t>(std::ceil(share * static_cast<double>(values.size())));
  const size_t index = std::clamp<size_t>(rank, 1, values.size()) - 1;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(index), values.end());
  return values[index];
}

}  // namespace limen::perception
