// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "analysis/answer_tables/table.h"
#include "analysis/output/result.h"

namespace limen::analysis {

/// A table as it was given, and which of its rows were taken.
struct TableInput {
  std::string file, hash;  ///< SHA-256
  size_t allRows = 0;
  std::vector<std::string> where;  ///< conditions on rows, as filterRows() takes them
  Table table;                     ///< rows that were taken
};

/// Throws Error as Table::read() and filterRows().
TableInput readTableInput(const std::string& file, const std::vector<std::string>& where = {});

/// Opens every result on a table, as headOf(StudyAnswers) those on a study.
Section headOf(const TableInput& input);

}  // namespace limen::analysis
