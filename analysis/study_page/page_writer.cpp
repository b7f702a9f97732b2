// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study_page/page_writer.h"

#include <fmt/format.h>

#include <cctype>

#include "analysis/output/result_text.h"
#include "analysis/output/text_output.h"

namespace limen::analysis {
namespace {

/// Stands where a figure comes. escapeHtml() lets no such letter through, so that no title can forge it.
constexpr char kMark = '\x01';

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

std::string link(const std::string& path, const std::string& text) {
  return "<a href=\"" + escapeHtml(path) + "\">" + escapeHtml(text) + "</a>";
}

}  // namespace

void PageWriter::openSection(const std::string& id, const std::string& title) {
  html_ += "<section id=\"" + escapeHtml(id) + "\"><h2>" + escapeHtml(title) + "</h2>\n";
}

void PageWriter::closeSection() { html_ += "</section>\n"; }

void PageWriter::heading(const std::string& text) { html_ += "<h3>" + escapeHtml(text) + "</h3>\n"; }

void PageWriter::paragraph(const std::string& text) { html_ += "<p>" + escapeHtml(text) + "</p>\n"; }

void PageWriter::notice(const std::string& text, bool bad) {
  html_ += std::string("<p class=\"notice") + (bad ? " bad" : "") + "\" role=\"note\">" + escapeHtml(text) +
           "</p>\n";
}

void PageWriter::list(const std::vector<std::string>& items) {
  if (items.empty()) return;
  html_ += "<ul class=\"prose\">";
  for (const std::string& item : items) html_ += "<li>" + escapeHtml(item) + "</li>";
  html_ += "</ul>\n";
}

void PageWriter::table(const ResultTable& table, const std::string& words, const std::string& file,
                       size_t openRows) {
  if (table.rows() == 0) return;
  std::vector<const Column*> columns;
  for (const Column& column : table.columns)
    if (column.shownToPeople()) columns.push_back(&column);
  const auto look = [](const Column& column) { return std::string(column.isNumber() ? " class=\"num\"" : ""); };
  const bool folded = table.rows() > openRows;
  const std::string id = fmt::format("table-{}", ++tables_);
  const std::string caption = fmt::format("<b>Table {}.</b> ", tables_) + escapeHtml(words) +
                              (file.empty() ? "" : " " + link(file, "CSV"));
  // Beside the table and not in it: a caption in it would be scrolled away with a wide one.
  html_ += folded ? "<details><summary class=\"caption\" id=\"" + id + "\">" + caption + "</summary>\n"
                  : "<p class=\"caption\" id=\"" + id + "\">" + caption + "</p>\n";
  html_ += "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-labelledby=\"" + id +
           "\"><table aria-labelledby=\"" + id + "\"><thead><tr>";
  for (const Column* column : columns)
    html_ += "<th scope=\"col\"" + look(*column) + ">" + escapeHtml(column->title) + "</th>";
  html_ += "</tr></thead>\n<tbody>\n";
  for (size_t row = 0; row < table.rows(); ++row) {
    html_ += "<tr>";
    for (const Column* column : columns) {
      const std::string cell = cellText(*column, column->cells[row]);
      html_ += column == columns.front()
                   ? "<th scope=\"row\"" + look(*column) + ">" + breakable(cell) + "</th>"
                   : "<td" + look(*column) + ">" + cellHtml(cell) + "</td>";
    }
    html_ += "</tr>\n";
  }
  html_ += "</tbody></table></div>\n";
  if (folded) html_ += "</details>\n";
}

void PageWriter::figure(Figure figure, const std::string& caption) {
  const std::string base = "figures/" + figure.name;
  html_ += "<figure>" + (kMark + figure.name) + kMark +
           fmt::format("<figcaption><b>Figure {}.</b> ", figures_.size() + 1) + escapeHtml(caption) + " " +
           link(base + ".pdf", "PDF") + " " + link(base + ".svg", "SVG") + "</figcaption></figure>\n";
  figures_.push_back(std::move(figure));
}

void PageWriter::file(const std::string& path, const std::string& bytes, const std::string& meaning) {
  files_.push_back({path, bytes, meaning});
}

std::string PageWriter::body(const std::map<std::string, std::string>& drawn) const {
  std::string out;
  size_t from = 0;
  for (size_t at; (at = html_.find(kMark, from)) != std::string::npos;) {
    const size_t end = html_.find(kMark, at + 1);
    out += html_.substr(from, at - from) + drawn.at(html_.substr(at + 1, end - at - 1));
    from = end + 1;
  }
  return out + html_.substr(from);
}

}  // namespace limen::analysis
