// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/correlations/relation_table.h"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <set>

#include "analysis/answer_tables/answer_columns.h"
#include "experiments/base/error.h"
#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

constexpr size_t kLeastRows = 3;

double shareAt(const Table& table, size_t row, size_t column, const char* what) {
  const double value = table.number(row, column);
  if (value < 0.0 || value > 1.0)
    throw Error("'" + table.text(row, column) + "' is no " + what, table.place(row, column),
                "give fractions from 0 to 1, not per cent");
  return value;
}

std::vector<size_t> scoreColumns(const Table& table, const RelationColumns& columns) {
  if (columns.x.empty()) throw Error("no column to set against another", "--x", "name one or more");
  const bool both = !columns.y.empty() && !columns.outcome.empty();
  if (both || (columns.y.empty() && columns.outcome.empty()))
    throw Error(both ? "both were given" : "neither was given", "--y, --outcome",
                "--y for numbers, --outcome for 0 and 1");
  std::set<std::string> seen{columns.y.empty() ? columns.outcome : columns.y};
  for (const std::string& name : columns.x)
    if (!seen.insert(name).second)
      throw Error("column '" + name + "' is set against itself or named twice", "--x");
  return table.columns(columns.x, "--x");
}

}  // namespace

RowGroups groupRows(const Table& table, const std::vector<std::string>& by, const std::string& option) {
  const std::vector<size_t> columns = table.columns(by, option);
  RowGroups out;
  std::map<std::vector<std::string>, size_t> known;
  for (size_t row = 0; row < table.rows(); ++row) {
    std::vector<std::string> values, words;
    for (const size_t column : columns) {
      values.push_back(table.text(row, column));
      words.push_back(table.header()[column] + "=" + values.back());
    }
    const auto [place, fresh] = known.emplace(values, out.names.size());
    if (fresh) out.names.push_back(join(words));
    out.of.push_back(place->second);
  }
  return out;
}

std::vector<RelationRows> readRelations(const Table& table, const RelationColumns& columns,
                                        const std::string& file) {
  const std::vector<size_t> x = scoreColumns(table, columns);
  const bool binary = !columns.outcome.empty();
  const size_t y = binary ? table.column(columns.outcome, "--outcome") : table.column(columns.y, "--y");
  const std::optional<size_t> cluster = table.optionalColumn(columns.cluster, "--cluster");
  const RowGroups groups = groupRows(table, columns.by, "--by");
  if (table.rows() < kLeastRows)
    throw Error(fmt::format("{} row(s), and a relation needs {} at least", table.rows(), kLeastRows), file);

  std::vector<RelationRows> out(groups.names.size());
  std::vector<std::map<std::string, size_t>> known(out.size());
  for (size_t i = 0; i < out.size(); ++i) {
    out[i].name = groups.names[i];
    out[i].x.resize(x.size());
  }
  for (size_t row = 0; row < table.rows(); ++row) {
    RelationRows& group = out[groups.of[row]];
    for (size_t i = 0; i < x.size(); ++i)
      group.x[i].push_back(columns.probabilities ? shareAt(table, row, x[i], "probability")
                                                 : table.number(row, x[i]));
    if (binary)
      group.outcome.push_back(static_cast<int>(readBinary(table, row, y, "--y takes other numbers")));
    else
      group.y.push_back(columns.rates ? shareAt(table, row, y, "rate") : table.number(row, y));
    ++group.rows;
    if (!cluster) continue;
    auto& numbers = known[groups.of[row]];
    group.clusters.push_back(numbers.emplace(readLabel(table, row, *cluster), numbers.size()).first->second);
    group.clusterCount = numbers.size();
  }
  return out;
}

}  // namespace limen::analysis
