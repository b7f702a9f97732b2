// SPDX-License-Identifier: BSD-3-Clause
#include "study/export/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <nlohmann/json.hpp>

namespace limen::study {
namespace {

std::string quoted(const std::string& value) {
  if (value.find_first_of(",\"\r\n") == std::string::npos) return value;
  std::string out = "\"";
  for (const char c : value) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}

std::string flat(std::string value) {
  std::replace_if(
      value.begin(), value.end(), [](char c) { return c == '\t' || c == '\n' || c == '\r'; }, ' ');
  return value.empty() ? "n/a" : value;
}

template <class Cell>
std::string lines(const Table& table, char separator, const std::string& missing, Cell cell) {
  std::string out;
  for (size_t i = 0; i < table.columns.size(); ++i)
    out += (i ? std::string(1, separator) : "") + cell(table.columns[i].name);
  out += '\n';
  for (const auto& row : table.rows) {
    for (size_t i = 0; i < row.size(); ++i)
      out += (i ? std::string(1, separator) : "") + (row[i] ? cell(*row[i]) : missing);
    out += '\n';
  }
  return out;
}

}  // namespace

void Table::add(std::vector<std::optional<std::string>> row) {
  assert(row.size() == columns.size());
  rows.push_back(std::move(row));
}

std::string toCsv(const Table& table) { return lines(table, ',', "", quoted); }
std::string toTsv(const Table& table) { return lines(table, '\t', "n/a", flat); }

nlohmann::json dictionary(const std::vector<Column>& columns) {
  nlohmann::json out = nlohmann::json::object();
  for (const Column& column : columns) {
    nlohmann::json& entry = out[column.name] = {{"Description", column.description}};
    if (!column.unit.empty()) entry["Units"] = column.unit;
    if (!column.levels.empty()) entry["Levels"] = column.levels;
  }
  return out;
}

std::string toText(double value) { return std::isfinite(value) ? fmt::format("{}", value) : "n/a"; }

}  // namespace limen::study
