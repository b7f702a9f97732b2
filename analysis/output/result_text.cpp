// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/output/result_renderers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/output/text_output.h"
#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

constexpr size_t kTextWidth = 120;  // letters of a line of a table

std::string numberText(const Column& column, double value) {
  if (std::isnan(value)) return "-";
  if (std::isinf(value)) return value > 0.0 ? "inf" : "-inf";
  switch (column.kind) {
    case Kind::Significant:
      return fmt::format("{:.{}g}", value, column.digits);
    case Kind::Share:
      return percentText(value);
    case Kind::Probability:
      return pText(value);
    case Kind::ShareInterval:
      return fmt::format("{:.{}f}", 100.0 * value, column.digits);
    case Kind::Rounded:
      return formatNumber(value);
    default:
      return fixedText(value, column.digits);
  }
}

std::string intervalCell(const Column& column, const Interval& interval) {
  if (interval.low == interval.high) return "-";
  return numberText(column, interval.low) + " to " + numberText(column, interval.high) +
         (column.kind == Kind::ShareInterval ? " %" : "");
}

using Lines = std::vector<std::vector<std::string>>;  ///< heading, then rows

size_t widthOf(const std::vector<std::string>& cells) {
  size_t out = 0;
  for (const std::string& cell : cells) out = std::max(out, textWidth(cell));
  return out + 2;
}

/// Columns that do not fit beside the others follow below, with the first column again.
std::string tableText(const ResultTable& table) {
  if (table.rows() == 0) return {};
  std::vector<std::vector<std::string>> columns;
  std::vector<bool> isLeft;
  for (const Column& column : table.columns) {
    if (!column.shownToPeople()) continue;
    columns.push_back({column.title});
    isLeft.push_back(!column.isNumber());
    for (const ResultCell& cell : column.cells) columns.back().push_back(cellText(column, cell));
  }
  if (columns.empty()) return {};
  std::string out = "\n" + (table.title.empty() ? "" : "  " + table.title + "\n");
  for (size_t from = 1, block = 0; block == 0 || from < columns.size(); ++block) {
    Lines lines(table.rows() + 1);
    std::vector<size_t> left;
    size_t width = 2, count = 0;
    const auto add = [&](size_t i) {
      if (isLeft[i]) left.push_back(count);
      for (size_t row = 0; row < lines.size(); ++row) lines[row].push_back(columns[i][row]);
      width += widthOf(columns[i]);
      ++count;
    };
    add(0);
    while (from < columns.size() && (count < 2 || width + widthOf(columns[from]) <= kTextWidth)) add(from++);
    out += (block > 0 ? "\n" : "") + alignedText(lines, left);
  }
  return out;
}

}  // namespace

std::string cellText(const Column& column, const ResultCell& cell) {
  const ResultCell::Value& value = cell.value();
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* texts = std::get_if<std::vector<std::string>>(&value)) return join(*texts);
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "yes" : "no";
  if (const auto* whole = std::get_if<int64_t>(&value))
    return column.kind == Kind::Integer ? std::to_string(*whole)
                                        : numberText(column, static_cast<double>(*whole));
  if (const auto* number = std::get_if<double>(&value)) return numberText(column, *number);
  if (const auto* count = std::get_if<CountOf>(&value)) return fmt::format("{}/{}", count->number, count->of);
  if (const auto* interval = std::get_if<Interval>(&value)) return intervalCell(column, *interval);
  return column.isNumber() ? "-" : "";
}

std::string toText(const Section& section) {
  std::string out = section.title.empty() ? "" : section.title + "\n";
  std::vector<std::vector<std::string>> facts;
  for (const Column& fact : section.facts)
    if (fact.shownToPeople() && !fact.identifies)
      facts.push_back({fact.title, cellText(fact, fact.cells.front())});
  out += alignedText(facts, {0, 1});
  for (const ResultTable& table : section.tables) out += tableText(table);
  for (const std::string& note : section.notes) out += "  " + note + "\n";
  return out;
}

std::string toText(const Result& result) {
  std::string out = toText(result.head);
  for (const Section& section : result.sections) out += "\n" + toText(section);
  if (!result.notes.empty()) out += "\n";
  for (const std::string& note : result.notes) out += note + "\n";
  return out;
}

}  // namespace limen::analysis
