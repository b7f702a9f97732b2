// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "analysis/answer_tables/table.h"

namespace limen::analysis {

/// Columns of a table that are set against each other, by name; "" or empty for none.
struct RelationColumns {
  std::vector<std::string> x;
  std::string y, outcome;  ///< one of both
  std::vector<std::string> by;
  std::string cluster;
  bool rates = false;          ///< y are rates from 0 to 1
  bool probabilities = false;  ///< x are
};

/// The rows that have the same values in the `by` columns, in the order of the file.
struct RelationRows {
  std::string name;                    ///< "scene=bunny, part=2"; "" without `by`
  std::vector<std::vector<double>> x;  ///< one list a column
  std::vector<double> y;
  std::vector<int> outcome;
  std::vector<size_t> clusters;  ///< number of each row's within the group; empty without `cluster`
  size_t rows = 0, clusterCount = 0;
};

/// Groups in order of first appearance. Throws Error: no such column (with the nearest), a column twice or
/// against itself, fewer than 3 rows in all; with file, line and column: fields that are no finite numbers,
/// outcomes other than 0 and 1, rates or probabilities outside 0 .. 1.
std::vector<RelationRows> readRelations(const Table& table, const RelationColumns& columns,
                                        const std::string& file);

/// Splits rows into groups by their text in columns: names and, for each row, the group's number.
struct RowGroups {
  std::vector<std::string> names;
  std::vector<size_t> of;
};
RowGroups groupRows(const Table& table, const std::vector<std::string>& by, const std::string& option);

}  // namespace limen::analysis
