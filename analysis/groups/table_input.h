// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "analysis/data/table.h"

namespace limen::analysis {

/// A table as it was given, and which of its rows were taken.
struct TableInput {
  std::string file, hash;  ///< SHA-256
  size_t allRows = 0;
  std::vector<std::string> where;  ///< conditions on rows, as filterRows() takes them
  Table table;                     ///< rows that were taken
};

/// Throws Error as Table::read() and filterRows().
TableInput readTableInput(const std::string& file, const std::vector<std::string>& where);

/// Opens every result on a table, as headText() of a study does.
std::string headText(const TableInput& input);
nlohmann::json headJson(const TableInput& input);

}  // namespace limen::analysis
