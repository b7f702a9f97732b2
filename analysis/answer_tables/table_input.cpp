// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/answer_tables/table_input.h"

#include "analysis/answer_tables/row_filter.h"
#include "experiments/base/hash.h"

namespace limen::analysis {

TableInput readTableInput(const std::string& file, const std::vector<std::string>& where) {
  const Table all = Table::read(file);
  return {file, sha256File(file), all.rows(), where, filterRows(all, where)};
}

Section headOf(const TableInput& input) {
  Section out;
  out.fact(text("file"), input.file);
  out.fact(text("sha256", "SHA-256"), input.hash);
  out.fact(integer("rows"), input.table.rows());
  out.fact(input.where.empty() ? forData(integer("rows_in_file")) : integer("rows_in_file"), input.allRows);
  out.fact(ifAny(list("where")), input.where);
  return out;
}

}  // namespace limen::analysis
