// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "perception/psychometrics/random.h"

namespace limen::study {

/// At most `atMost` neighbours in a row may share a value. `values`: one per item.
struct RunLimit {
  std::vector<int> values;
  int atMost = 1;
};

/// Whether no run of `order` (numbers of items) is longer than allowed.
bool keepsLimits(const std::vector<size_t>& order, const std::vector<RunLimit>& limits);

enum class Feasibility { Possible, Impossible, NotFound };
/// Whether there is an order of `items` items within the limits. NotFound: neither an order nor a proof that
/// there is none within a bounded search, which only happens with several limits.
Feasibility feasibility(size_t items, const std::vector<RunLimit>& limits);

/// A random order within the limits, which must be possible. Every allowed order is equally likely as long as
/// one in some hundred orders is allowed; narrower limits are reached by swaps, then by construction, which
/// always ends.
std::vector<size_t> limitedShuffle(size_t items, const std::vector<RunLimit>& limits,
                                   psychometrics::Random& random);

}  // namespace limen::study
