// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/groups/table_input.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "analysis/data/row_filter.h"
#include "experiments/base/hash.h"
#include "experiments/base/text.h"

namespace limen::analysis {

TableInput readTableInput(const std::string& file, const std::vector<std::string>& where) {
  const Table all = Table::read(file);
  return {file, sha256File(file), all.rows(), where, filterRows(all, where)};
}

std::string headText(const TableInput& input) {
  std::string out = fmt::format("{} (SHA-256 {}): ", input.file, input.hash.substr(0, 12));
  if (input.where.empty()) return out + fmt::format("{} rows\n", input.allRows);
  return out +
         fmt::format("{} of {} rows, those with {}\n", input.table.rows(), input.allRows, join(input.where));
}

nlohmann::json headJson(const TableInput& input) {
  return {{"file", input.file},
          {"sha256", input.hash},
          {"rows", input.table.rows()},
          {"rows_in_file", input.allRows},
          {"where", input.where}};
}

}  // namespace limen::analysis
