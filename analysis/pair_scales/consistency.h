// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "analysis/pair_scales/pair_table.h"

namespace limen::analysis {

/// Circular triads (a over b, b over c, c over a) of one who judged each pair of items once: d = n(n-1)(2n-1)
/// / 12 - sum a_i^2 / 2, a_i being how often item i was chosen (Kendall and Babington Smith 1940).
/// limen::Error unless these sum to n(n-1)/2 and lie within 0 .. n-1.
int64_t circularTriads(const std::vector<int64_t>& chosen);
/// The most there can be: (n^3 - n) / 24 for odd n, (n^3 - 4n) / 24 for even.
int64_t mostCircularTriads(int64_t items);
/// What answers at random lead to: a quarter of all triads.
double expectedCircularTriads(int64_t items);

/// Over a subject's rounds in which every pair was judged exactly once.
struct SubjectConsistency {
  std::string subject;
  size_t rounds = 0;    ///< 0: no round was of that kind, and the rest is none
  double triads = 0.0;  ///< mean over rounds
  double coefficient =
      0.0;  ///< Kendall's coefficient of consistency zeta = 1 - d / most, 1: no circular triad
};

/// One entry for each subject; empty for fewer than 3 items, which have no triads.
std::vector<SubjectConsistency> subjectConsistencies(const PairGroup& group);

}  // namespace limen::analysis
