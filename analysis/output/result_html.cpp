// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/output/result_renderers.h"

#include <fmt/format.h>

#include <cctype>
#include <cmath>

#include "analysis/output/text_output.h"
#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

/// A cell as typographers want it: a true minus, a dash for what is not there, a sign for what has no bound.
std::string cellHtml(const std::string& text) {
  if (text == "-" || text.empty()) return text.empty() ? "" : "–";
  if (text == "inf") return "∞";
  if (text == "-inf") return "−∞";
  std::string out = escapeHtml(text);
  for (size_t at = 0; at + 1 < out.size(); ++at) {
    const bool opens = at == 0 || out[at - 1] == ' ';
    if (out[at] == '-' && opens && std::isdigit(static_cast<unsigned char>(out[at + 1])))
      out.replace(at, 1, "−");
  }
  return out;
}

/// As JavaScript's Number() reads it.
std::string dataOf(const ResultCell& cell) {
  if (const auto* whole = std::get_if<int64_t>(&cell.value())) return fmt::format(" data-v=\"{}\"", *whole);
  const auto* number = std::get_if<double>(&cell.value());
  if (!number || std::isnan(*number)) return "";
  return " data-v=\"" +
         (std::isfinite(*number) ? shortestNumber(*number)
          : *number > 0          ? "Infinity"
                                 : "-Infinity") +
         "\"";
}

}  // namespace

std::string toHtml(const ResultTable& table, const HtmlOptions& options) {
  if (table.rows() == 0) return "";
  std::vector<const Column*> columns;
  for (const Column& column : table.columns)
    if (column.shownToPeople()) columns.push_back(&column);
  const auto look = [](const Column& column) { return column.isNumber() ? " class=\"num\"" : ""; };
  std::string out = options.box + "<table" + options.attributes + ">";
  if (!options.caption.empty()) out += "<caption>" + options.caption + "</caption>\n";
  out += "<thead><tr>";
  for (const Column* column : columns) {
    const std::string title = escapeHtml(column->title), name = escapeHtml(column->name);
    out += fmt::format("<th scope=\"col\"{}", look(*column));
    if (options.sortable && !name.empty()) out += " title=\"" + name + "\"";
    out += ">" + (options.sortable ? "<button type=\"button\">" + title + "</button>" : title) + "</th>";
  }
  out += "</tr></thead>\n<tbody>\n";
  for (size_t row = 0; row < table.rows(); ++row) {
    out += "<tr" + (options.ofRow ? options.ofRow(row) : "") + ">";
    for (const Column* column : columns) {
      const ResultCell& cell = column->cells[row];
      // What is not there has no place in an order.
      const std::string text = options.sortable && cell.empty() ? "" : cellText(*column, cell);
      if (options.rowHeads && column == columns.front())
        out += fmt::format("<th scope=\"row\"{}>{}</th>", look(*column), breakable(text));
      else
        out += fmt::format("<td{}{}>{}</td>", look(*column), options.sortable ? dataOf(cell) : "",
                           column->kind == Kind::Html ? text : cellHtml(text));
    }
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

}  // namespace limen::analysis
