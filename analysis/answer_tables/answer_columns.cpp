// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/answer_tables/answer_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>

#include "analysis/output/text_output.h"
#include "experiments/base/error.h"

namespace limen::analysis {

AnswerReader::AnswerReader(const Table& table, const AnswerColumns& columns, bool values) : table_(table) {
  const bool outcome = !columns.outcome.empty(), counts = !columns.correct.empty() || !columns.trials.empty(),
             value = !columns.value.empty();
  const std::string kinds = values ? "--outcome, or --k and --n, or --value" : "--outcome, or --k and --n";
  if (outcome + counts + value > 1)
    throw Error("answers are of one kind only", outcome ? "--outcome" : "--k, --n", "give " + kinds);
  if (outcome + counts + value == 0)
    throw Error("the columns with the answers are not named", table.name(), "give " + kinds);
  if (counts && (columns.correct.empty() || columns.trials.empty()))
    throw Error("counts are two columns", columns.correct.empty() ? "--n" : "--k",
                "name the other with " + std::string(columns.correct.empty() ? "--k" : "--n"));
  if (outcome) {
    first_ = table.column(columns.outcome, "--outcome");
  } else if (value) {
    kind_ = Kind::Value;
    first_ = table.column(columns.value, "--value");
  } else {
    kind_ = Kind::Counts;
    first_ = table.column(columns.correct, "--k");
    trials_ = table.column(columns.trials, "--n");
  }
}

AnswerCount AnswerReader::count(size_t row) const {
  if (kind_ == Kind::Counts) return readCounts(table_, row, first_, trials_);
  return {readBinary(table_, row, first_, "outcomes are 0 or 1; counts take --k and --n"), 1};
}

double AnswerReader::value(size_t row) const {
  if (kind_ == Kind::Value) return table_.number(row, first_);
  const AnswerCount answer = count(row);
  return static_cast<double>(answer.correct) / static_cast<double>(answer.trials);
}

std::string AnswerReader::meaning() const {
  const std::string& first = table_.header()[first_];
  if (kind_ == Kind::Value) return "mean of '" + first + "'";
  return "rate of '" + first + "'" +
         (kind_ == Kind::Counts ? " in '" + table_.header()[trials_] + "'" : std::string());
}

int64_t readBinary(const Table& table, size_t row, size_t column, const std::string& hint) {
  static const std::map<std::string, int64_t> kWords = {
      {"yes", 1}, {"true", 1},  {"correct", 1},   {"right", 1}, {"y", 1}, {"t", 1},
      {"no", 0},  {"false", 0}, {"incorrect", 0}, {"wrong", 0}, {"n", 0}, {"f", 0}};
  std::string word = table.text(row, column);
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (const auto known = kWords.find(word); known != kWords.end()) return known->second;
  if (!finiteNumber(word))
    throw Error("'" + table.text(row, column) + "' is neither 0 nor 1", table.place(row, column),
                hint + "; yes and no, true and false, correct and incorrect, right and wrong are taken too");
  const double value = table.number(row, column);
  if (value != 0.0 && value != 1.0)
    throw Error("'" + table.text(row, column) + "' is neither 0 nor 1", table.place(row, column), hint);
  return value == 1.0 ? 1 : 0;
}

AnswerCount readCounts(const Table& table, size_t row, size_t correct, size_t trials) {
  const AnswerCount out{table.count(row, correct), table.count(row, trials)};
  if (out.trials == 0)
    throw Error("no trials", table.place(row, trials), "leave rows out that nobody was shown");
  if (out.correct > out.trials)
    throw Error(fmt::format("{} of {} trials", out.correct, out.trials), table.place(row, correct),
                "there cannot be more than all");
  return out;
}

const std::string& readLabel(const Table& table, size_t row, size_t column) {
  const std::string& text = table.text(row, column);
  if (text.empty()) throw Error("is empty", table.place(row, column), "say whose or what it is");
  return text;
}

}  // namespace limen::analysis
