// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace limen::analysis {

/// p values adjusted for multiple comparisons, in the order given. limen::Error names the index of one
/// that is not between 0 and 1. No values give none.

/// Holm (1979), step down: max over j <= i of min(1, (m - j + 1) p_(j)). Bounds the family-wise error rate.
std::vector<double> adjustHolm(const std::vector<double>& p);

/// Benjamini and Hochberg (1995), step up: min over j >= i of min(1, m p_(j) / j). Bounds the false discovery
/// rate, for independent or positively dependent tests.
std::vector<double> adjustBenjaminiHochberg(const std::vector<double>& p);

}  // namespace limen::analysis
