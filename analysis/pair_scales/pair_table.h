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

  /// Index of an item, which is added if it is new.
  size_t item(const std::string& name);
  size_t subject(const std::string& name);
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

}  // namespace limen::analysis
