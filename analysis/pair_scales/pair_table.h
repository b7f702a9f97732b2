// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "analysis/answer_tables/table.h"

namespace limen::analysis {

/// "Which of the two?": one answer, or `count` equal ones.
struct PairJudgement {
  size_t winner = 0, loser = 0;  ///< index of PairGroup::items
  int64_t count = 1;
  size_t subject = 0;  ///< index of PairGroup::subjects; 0 if nobody is told apart
  size_t round = 0;    ///< passes through the pairs by one subject under one condition
};

/// Judgements that make one scale.
struct PairGroup {
  std::string name;                   ///< "scene=bunny"; "" if there is one only
  std::vector<std::string> items;     ///< in order of first appearance
  std::vector<std::string> subjects;  ///< empty if nobody is told apart
  std::vector<PairJudgement> judgements;
  bool ordered = false;     ///< which item was shown first is known
  int64_t firstChosen = 0;  ///< judgements for it
  int64_t judged = 0;       ///< all judgements
};

/// Columns by name; "" or empty for none.
struct PairColumns {
  std::string winner, loser;          ///< or:
  std::string first, second, chosen;  ///< chosen holds the name of one of the two
  std::string count, subject, round;
  std::vector<std::string> by;
};

/// Groups in order of first appearance. Throws Error: neither or both ways of naming the columns, no such
/// column; with file, line and column: empty names, an item against itself, a choice that is none of the two,
/// counts that are negative or not whole.
std::vector<PairGroup> readPairs(const Table& table, const PairColumns& columns);

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
