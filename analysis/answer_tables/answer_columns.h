// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "analysis/answer_tables/table.h"

namespace limen::analysis {

/// Names of the columns that hold answers, as typed: single trials or counts, or any other measured value.
struct AnswerColumns {
  std::string outcome;          ///< 0 or 1, one trial a row
  std::string correct, trials;  ///< so many of so many
  std::string value;            ///< any number, where a command takes one
};

struct AnswerCount {
  int64_t correct = 0, trials = 1;
};

/// Reads the answers of a table. Every Error has line and column.
class AnswerReader {
 public:
  /// Throws Error unless exactly one kind of columns is named, or one is missing. `values`: whether --value
  /// is an option of the command.
  AnswerReader(const Table& table, const AnswerColumns& columns, bool values = false);

  bool counts() const { return kind_ != Kind::Value; }
  /// Of outcomes and counts. Throws Error for an outcome that is neither 0 nor 1, for counts that are
  /// negative, not whole, more correct than trials, or no trials.
  AnswerCount count(size_t row) const;
  /// The value, or the rate of count().
  double value(size_t row) const;
  /// Where the answer of a row stands, for messages.
  std::string place(size_t row) const { return table_.place(row, first_); }
  const std::string& column() const { return table_.header()[first_]; }
  /// "rate of 'seen'", "rate of 'k' in 'n'", "mean of 'time'"
  std::string meaning() const;

 private:
  enum class Kind { Outcome, Counts, Value };
  const Table& table_;
  Kind kind_ = Kind::Outcome;
  size_t first_ = 0, trials_ = 0;
};

/// 0 or 1, or words for them: yes and no, true and false, correct and incorrect, right and wrong, y and n, t
/// and f, in any case. Throws Error with line and column.
int64_t readBinary(const Table& table, size_t row, size_t column, const std::string& hint);
/// `correct` of `trials`, with trials. Throws Error with line and column.
AnswerCount readCounts(const Table& table, size_t row, size_t correct, size_t trials);
/// Text that is not empty. Throws Error with line and column.
const std::string& readLabel(const Table& table, size_t row, size_t column);

}  // namespace limen::analysis
