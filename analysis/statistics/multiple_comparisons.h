// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace limen::analysis {

/// p values adjusted for how many were looked at, in the order given. limen::Error names the index of one
/// that is not between 0 and 1. No values give none.

/// Holm (1979), step down: max over j <= i of min(1, (m - j + 1) p_(j)). Bounds the chance of any false
/// claim.
std::vector<double> adjustHolm(const std::vector<double>& p);

/// Benjamini and Hochberg (1995), step up: min over j >= i of min(1, m p_(j) / j). Bounds the expected share
/// of false claims, for independent or positively dependent tests.
std::vector<double> adjustBenjaminiHochberg(const std::vector<double>& p);

}  // namespace limen::analysis
