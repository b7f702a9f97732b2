// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "analysis/answer_tables/table.h"
#include "analysis/output/result.h"

namespace limen::analysis {

/// Whether a file is an SQLite database, which only a result store can be here; anything else is read as a
/// table of text. Throws Error if there is no such file or it cannot be read.
bool isDatabase(const std::string& path);

/// Rows in which every named column has its value: "counts=1". A column that is named several times may have
/// any of its values. Numbers are compared as numbers. Throws Error for text without '=', a column that is
/// not there, and if no row is left.
Table filterRows(const Table& table, const std::vector<std::string>& conditions,
                 const std::string& option = "--where");

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
