// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/multiple_comparisons.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "analysis/statistics/detail/check.h"
#include "experiments/base/error.h"

namespace limen::analysis {
std::vector<double> adjustHolm(const std::vector<double>& p) {
  for (size_t i = 0; i < p.size(); ++i)
    if (!(p[i] >= 0.0 && p[i] <= 1.0)) throw Error(fmt::format("{} is no p value", p[i]), indexed("p", i));
  std::vector<size_t> order(p.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return p[a] < p[b]; });
  std::vector<double> adjusted(p.size());
  double highest = 0.0;
  for (size_t i = 0; i < order.size(); ++i) {
    highest = std::max(highest, std::min(1.0, static_cast<double>(p.size() - i) * p[order[i]]));
    adjusted[order[i]] = highest;
  }
  return adjusted;
}

}  // namespace limen::analysis
