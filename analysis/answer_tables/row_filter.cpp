// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/answer_tables/row_filter.h"

#include <algorithm>
#include <map>

#include "experiments/base/error.h"
#include "experiments/base/text.h"

namespace limen::analysis {

Table filterRows(const Table& table, const std::vector<std::string>& conditions, const std::string& option) {
  std::map<size_t, std::vector<std::string>> wanted;
  for (const std::string& condition : conditions) {
    const size_t equals = condition.find('=');
    if (equals == std::string::npos)
      throw Error("'" + condition + "' has no value", option, "write COLUMN=VALUE");
    wanted[table.column(condition.substr(0, equals), option)].push_back(condition.substr(equals + 1));
  }
  const auto equal = [](const std::string& a, const std::string& b) {
    const auto x = finiteNumber(a), y = finiteNumber(b);
    return a == b || (x && y && *x == *y);
  };
  std::vector<size_t> rows;
  for (size_t row = 0; row < table.rows(); ++row)
    if (std::all_of(wanted.begin(), wanted.end(), [&](const auto& one) {
          return std::any_of(one.second.begin(), one.second.end(), [&](const std::string& value) {
            return equal(table.text(row, one.first), value);
          });
        }))
      rows.push_back(row);
  if (rows.empty())
    throw Error("no row has " + join(conditions), table.name() + " (" + option + ")", "look at its values");
  return table.only(rows);
}

}  // namespace limen::analysis
