// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/answer_tables/table_input.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>

#include "analysis/answer_tables/choice.h"
#include "analysis/output/text_output.h"
#include "experiments/base/error.h"
#include "experiments/base/hash.h"
#include "experiments/base/text.h"

namespace limen::analysis {

bool isDatabase(const std::string& path) {
  static const std::string kMagic("SQLite format 3\0", 16);
  if (std::filesystem::is_directory(path))
    throw Error("is a folder", path, "name the result store or the CSV file in it");
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Error("no such file, or not readable", path, "name a result store or a CSV file");
  std::string start(kMagic.size(), '\0');
  in.read(start.data(), static_cast<std::streamsize>(start.size()));
  return in.gcount() == static_cast<std::streamsize>(start.size()) && start == kMagic;
}

Table filterRows(const Table& table, const std::vector<std::string>& conditions, const std::string& option) {
  std::map<size_t, std::vector<std::string>> wanted;
  for (const std::string& condition : conditions) {
    const auto [name, value] = splitAssignment(condition, "has no value", option, "write COLUMN=VALUE");
    wanted[table.column(name, option)].push_back(value);
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
