// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <vector>

namespace limen::analysis {

/// p values adjusted for multiple comparisons, in the order given. limen::Error names the index of one
/// that is not between 0 and 1. No values give none.

/// Holm (1979), step down: max over j <= i of min(1, (m - j + 1) p_(j)). Bounds the family-wise error rate.
std::vector<double> adjustHolm(const std::vector<double>& p);

/// The same for rows of which each has a p or none: sets `adjusted` of those that have one. `p` and
/// `adjusted` are members, or functions of a row.
template <class Rows, class P, class Adjusted>
void adjustHolm(Rows& rows, P p, Adjusted adjusted) {
  std::vector<double> values;
  for (auto& row : rows)
    if (const std::optional<double> value = std::invoke(p, row)) values.push_back(*value);
  const std::vector<double> found = adjustHolm(values);
  auto next = found.begin();
  for (auto& row : rows)
    if (std::optional<double>(std::invoke(p, row))) std::invoke(adjusted, row) = *next++;
}

}  // namespace limen::analysis
