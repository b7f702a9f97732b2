// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/observer_statistics/mixed_table.h"

#include "experiments/base/error.h"

namespace limen::analysis {

MixedRows readMixedRows(const Table& table, const std::string& group, const AnswerColumns& columns) {
  if (group.empty())
    throw Error("the column that says who answered is not named", table.name(), "give --group");
  const size_t own = table.column(group, "--group");
  const AnswerReader answers(table, columns);
  MixedRows out;
  out.measure = answers.meaning();
  out.group = group;
  for (size_t row = 0; row < table.rows(); ++row) {
    out.groups.push_back(readLabel(table, row, own));
    out.answers.push_back(answers.count(row));
    for (size_t column = 0; column < table.header().size(); ++column)
      out.columns[table.header()[column]].push_back(table.text(row, column));
  }
  out.place = [&table](size_t row, const std::string& column) {
    return table.place(row, table.column(column));
  };
  return out;
}

}  // namespace limen::analysis
