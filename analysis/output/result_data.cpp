// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/output/result_renderers.h"

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "analysis/output/text_output.h"
#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

using nlohmann::json;

/// The one or two named values of a cell.
using Values = std::vector<std::pair<std::string, ResultCell>>;

Values valuesOf(const Column& column, const ResultCell& cell) {
  if (column.second.empty()) return {{column.name, cell}};
  if (const auto* count = std::get_if<CountOf>(&cell.value()))
    return {{column.name, count->number}, {column.second, count->of}};
  if (const auto* interval = std::get_if<Interval>(&cell.value()))
    return {{column.name, interval->low}, {column.second, interval->high}};
  return {{column.name, {}}, {column.second, {}}};
}

json valueJson(const ResultCell& cell) {
  const ResultCell::Value& value = cell.value();
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* texts = std::get_if<std::vector<std::string>>(&value)) return *texts;
  if (const auto* flag = std::get_if<bool>(&value)) return *flag;
  if (const auto* whole = std::get_if<int64_t>(&value)) return *whole;
  if (const auto* number = std::get_if<double>(&value))
    return std::isfinite(*number) ? json(*number) : json();
  return {};
}

std::string valueField(const ResultCell& cell) {
  const ResultCell::Value& value = cell.value();
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* texts = std::get_if<std::vector<std::string>>(&value)) return join(*texts, "; ");
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "1" : "0";
  if (const auto* whole = std::get_if<int64_t>(&value)) return std::to_string(*whole);
  if (const auto* number = std::get_if<double>(&value))
    return std::isfinite(*number) ? shortestNumber(*number) : "";
  return {};
}

bool isData(const Column& column) { return column.audience != Column::Audience::People; }

void addJson(json& out, const Column& column, const ResultCell& cell) {
  if (!isData(column)) return;
  for (const auto& [name, value] : valuesOf(column, cell)) out[name] = valueJson(value);
}

json rowsJson(const ResultTable& table) {
  json out = json::array();
  for (size_t row = 0; row < table.rows(); ++row) {
    json line = json::object();
    for (const Column& column : table.columns) addJson(line, column, column.cells[row]);
    out.push_back(std::move(line));
  }
  return out;
}

class CsvWriter {
 public:
  void addColumn(const std::string& name) {
    if (places_.emplace(name, header_.size()).second) header_.push_back(name);
  }
  void addColumns(const Column& column) {
    if (!isData(column)) return;
    addColumn(column.name);
    if (!column.second.empty()) addColumn(column.second);
  }
  void addColumns(const ResultTable& table) {
    for (const Column& column : table.columns) addColumns(column);
  }
  void addRow(const ResultTable& table, size_t row) {
    rows_.emplace_back();
    for (const Column& column : table.columns) set(column, column.cells[row]);
  }
  void set(const std::string& name, const std::string& value) {
    rows_.back().resize(header_.size());
    rows_.back()[places_.at(name)] = value;
  }
  void set(const Column& column, const ResultCell& cell) {
    if (!isData(column)) return;
    for (const auto& [name, value] : valuesOf(column, cell)) set(name, valueField(value));
  }
  std::string text() const {
    std::string out = csvLine(header_);
    for (const std::vector<std::string>& row : rows_) out += csvLine(row);
    return out;
  }

 private:
  std::vector<std::string> header_;
  std::map<std::string, size_t> places_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace

json toJson(const Section& section) {
  json out = json::object();
  for (const Column& fact : section.facts) addJson(out, fact, fact.cells.front());
  for (const ResultTable& table : section.tables) {
    const json rows = rowsJson(table);
    json& own = out[table.name];
    if (own.is_null()) own = json::array();
    own.insert(own.end(), rows.begin(), rows.end());
  }
  out["notes"] = section.notes;
  return out;
}

json toJson(const Result& result) {
  json out = toJson(result.head);
  out["command"] = result.command;
  out["sections"] = json::array();
  for (const Section& section : result.sections) out["sections"].push_back(toJson(section));
  for (const std::string& note : result.notes) out["notes"].push_back(note);
  return out;
}

std::string jsonLine(const Result& result) {
  return toJson(result).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::string toCsv(const std::vector<Section>& sections) {
  CsvWriter out;
  out.addColumn("table");
  const auto eachKey = [](const Section& section, const auto& take) {
    for (const Column& fact : section.facts)
      if (fact.identifies) take(fact);
  };
  for (const Section& section : sections) eachKey(section, [&](const Column& fact) { out.addColumns(fact); });
  for (const Section& section : sections)
    for (const ResultTable& table : section.tables) out.addColumns(table);
  for (const Section& section : sections)
    for (const ResultTable& table : section.tables)
      for (size_t row = 0; row < table.rows(); ++row) {
        out.addRow(table, row);
        out.set("table", table.name);
        eachKey(section, [&](const Column& fact) { out.set(fact, fact.cells.front()); });
      }
  return out.text();
}

std::string toCsv(const ResultTable& table) {
  CsvWriter out;
  out.addColumns(table);
  for (size_t row = 0; row < table.rows(); ++row) out.addRow(table, row);
  return out.text();
}

}  // namespace limen::analysis
