// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/sweep/printed_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "analysis/output/text_output.h"
#include "analysis/sweep/grouping.h"
#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

using Verdict = PrintedTable::Verdict;
using Values = std::vector<std::optional<double>>;

constexpr double kEqualBand = 0.05;

/// What the row compares: a measurement, or the summed medians of passes. None if the run has it not.
std::optional<double> valueOf(const Cell& cell, const std::string& measure,
                              const std::vector<std::string>& passes) {
  if (passes.empty()) return measurementOf(cell.run, measure);
  double sum = 0.0;
  bool any = false;
  for (const PassTime& time : cell.passes)
    if (std::find(passes.begin(), passes.end(), time.pass) != passes.end()) sum += time.ms.median, any = true;
  return any ? std::optional(sum) : std::nullopt;
}

Values ratios(const Values& values, const Values& base) {
  Values out(values.size());
  for (size_t i = 0; i < values.size(); ++i)
    if (values[i] && base[i] && *base[i] != 0.0) out[i] = *values[i] / *base[i];
  return out;
}

/// -1, 0 or 1 of each ratio that there is.
std::set<int> ways(const Values& all) {
  std::set<int> out;
  for (const std::optional<double>& ratio : all)
    if (ratio) out.insert(*ratio < 1.0 - kEqualBand ? -1 : *ratio > 1.0 + kEqualBand ? 1 : 0);
  return out;
}

Verdict evaluate(const Values& printed, const Values& ours) {
  const std::set<int> theirs = ways(printed), own = ways(ours);
  if (theirs.empty() || own.empty()) return Verdict::None;
  const auto shared = std::count_if(own.begin(), own.end(), [&](int way) { return theirs.count(way) > 0; });
  const std::set<int> neither = {0};
  if (shared == 0) return own == neither || theirs == neither ? Verdict::Faint : Verdict::Differs;
  return static_cast<size_t>(shared) == own.size() ? Verdict::Agrees : Verdict::Partly;
}

std::string ownColumn(const Sweep& sweep, const Grouping& grouping, const Cell& cell) {
  const std::string scene = grouping.group(cell.run, "scene");
  return sweep.severalDevices ? scene + ", " + cell.run.device : scene;
}

PrintedTable compare(const Sweep& sweep, const Grouping& grouping, const nlohmann::json& table) {
  PrintedTable out;
  out.title = table.at("title");
  out.source = table.at("source");
  out.device = table.at("device");
  out.note = table.at("note");
  out.unit = table.at("unit");
  const std::string measure = table.at("measure");
  if (!measure.empty()) out.quantity = sweep.names.axis(measure, sweep.software).label();
  out.columns = table.at("columns").get<std::vector<std::string>>();
  std::vector<std::vector<const Cell*>> cellsOfRows;
  for (const nlohmann::json& row : table.at("rows")) {
    const auto keys = row.at("runs").get<std::set<std::string>>();
    std::vector<const Cell*> cells;
    for (const Cell& cell : sweep.cells)
      if (keys.count(cell.run.key)) {
        cells.push_back(&cell);
        indexIn(out.ownColumns, ownColumn(sweep, grouping, cell));
      }
    cellsOfRows.push_back(std::move(cells));
  }
  for (size_t i = 0; i < cellsOfRows.size(); ++i) {
    const nlohmann::json& from = table.at("rows").at(i);
    PrintedTable::Row row;
    row.name = from.at("name");
    row.base = from.at("relative_to");
    for (const nlohmann::json& value : from.at("values"))
      row.printed.push_back(value.is_null() ? std::nullopt : std::optional(value.get<double>()));
    row.ours.resize(out.ownColumns.size());
    for (const Cell* cell : cellsOfRows[i])
      row.ours[indexIn(out.ownColumns, ownColumn(sweep, grouping, *cell))] =
          valueOf(*cell, measure, from.at("passes").get<std::vector<std::string>>());
    out.rows.push_back(std::move(row));
  }
  for (PrintedTable::Row& row : out.rows) {
    const auto base = std::find_if(out.rows.begin(), out.rows.end(),
                                   [&](const PrintedTable::Row& other) { return other.name == row.base; });
    if (row.base.empty() || base == out.rows.end() || &*base == &row) continue;
    row.printedRatios = ratios(row.printed, base->printed);
    row.ourRatios = ratios(row.ours, base->ours);
    row.verdict = evaluate(row.printedRatios, row.ourRatios);
  }
  return out;
}

std::string cellHtml(const Values& values, const Values& all, size_t column) {
  std::string out = values[column] ? formatNumber(*values[column]) : "–";
  if (column < all.size() && all[column])
    out += fmt::format(" <small>×{}</small>", formatNumber(*all[column]));
  return "<td class=\"num\">" + out + "</td>";
}

std::string verdictHtml(Verdict verdict) {
  switch (verdict) {
    case Verdict::None:
      return "<td></td>";
    case Verdict::Agrees:
      return "<td class=\"held\">✓ same way</td>";
    case Verdict::Partly:
      return "<td>in part</td>";
    case Verdict::Faint:
      return "<td>within 5 %</td>";
    case Verdict::Differs:
      return "<td class=\"broken\">✗ other way</td>";
  }
  return "<td></td>";
}

std::string tableHtml(const PrintedTable& table) {
  std::string out = "<h3>" + escapeHtml(table.title) +
                    "</h3>\n<div class=\"scroll\"><table><caption>Printed: " +
                    escapeHtml(table.source + (table.device.empty() ? "" : ", " + table.device)) +
                    (table.unit.empty() ? "" : "; values in " + escapeHtml(table.unit)) +
                    (table.quantity.empty() ? "" : "; here " + escapeHtml(table.quantity)) + ".";
  if (!table.note.empty()) out += " " + escapeHtml(table.note);
  out += fmt::format(
      "</caption>\n<thead><tr><th rowspan=\"2\" scope=\"col\">setting</th><th colspan=\"{}\" "
      "scope=\"colgroup\">printed</th><th colspan=\"{}\" scope=\"colgroup\">here</th>"
      "<th rowspan=\"2\" scope=\"col\">ratios go</th></tr>\n<tr>",
      table.columns.size(), std::max<size_t>(table.ownColumns.size(), 1));
  for (const std::vector<std::string>* columns : {&table.columns, &table.ownColumns})
    for (const std::string& column : *columns)
      out += "<th scope=\"col\" class=\"num\">" + escapeHtml(column) + "</th>";
  if (table.ownColumns.empty()) out += "<th scope=\"col\">not measured</th>";
  out += "</tr></thead>\n<tbody>\n";
  for (const PrintedTable::Row& row : table.rows) {
    out += "<tr><th scope=\"row\">" + escapeHtml(row.name) + "</th>";
    for (size_t i = 0; i < table.columns.size(); ++i) out += cellHtml(row.printed, row.printedRatios, i);
    for (size_t i = 0; i < table.ownColumns.size(); ++i) out += cellHtml(row.ours, row.ourRatios, i);
    if (table.ownColumns.empty()) out += "<td></td>";
    out += verdictHtml(row.verdict) + "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

}  // namespace

std::vector<PrintedTable> comparePrinted(const Sweep& sweep) {
  std::vector<PrintedTable> out;
  const auto tables = sweep.experiment.report.find("published");
  if (tables == sweep.experiment.report.end()) return out;
  std::vector<const store::Run*> runs;
  for (const Cell& cell : sweep.cells) runs.push_back(&cell.run);
  const Grouping grouping(runs, sweep.names);
  for (const nlohmann::json& table : *tables) out.push_back(compare(sweep, grouping, table));
  return out;
}

std::string renderPrinted(const std::vector<PrintedTable>& tables) {
  if (tables.empty()) return "";
  std::string out =
      "<section id=\"published\"><h2>Beside printed numbers</h2>\n<p>Other machines and other scenes: values "
      "are not to be equal. Ratios to the base row (×) say whether a setting gains or loses; those within 5 "
      "% of 1 count as neither. Also in <a href=\"published.csv\">published.csv</a>.</p>\n";
  for (const PrintedTable& table : tables) out += tableHtml(table);
  return out + "</section>\n";
}

std::string printedCsv(const std::vector<PrintedTable>& tables) {
  std::string out = csvLine({"table", "row", "relative_to", "from", "column", "value", "ratio", "unit"});
  const auto text = [](const Values& values, size_t i) {
    return i < values.size() && values[i] ? shortestNumber(*values[i]) : std::string();
  };
  for (const PrintedTable& table : tables)
    for (const PrintedTable::Row& row : table.rows) {
      for (size_t i = 0; i < table.columns.size(); ++i)
        out += csvLine({table.title, row.name, row.base, "printed", table.columns[i], text(row.printed, i),
                        text(row.printedRatios, i), table.unit});
      for (size_t i = 0; i < table.ownColumns.size(); ++i)
        out += csvLine({table.title, row.name, row.base, "measured", table.ownColumns[i], text(row.ours, i),
                        text(row.ourRatios, i), table.unit});
    }
  return out;
}

}  // namespace limen::analysis
