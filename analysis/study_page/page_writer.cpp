// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study_page/page_writer.h"

#include <fmt/format.h>

#include "analysis/output/result_renderers.h"
#include "analysis/output/text_output.h"

namespace limen::analysis {
namespace {

/// Stands where a figure comes. escapeHtml() lets no such letter through, so that no title can forge it.
constexpr char kMark = '\x01';

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
  const bool folded = table.rows() > openRows;
  const std::string id = fmt::format("table-{}", ++tables_);
  const std::string caption = fmt::format("<b>Table {}.</b> ", tables_) + escapeHtml(words) +
                              (file.empty() ? "" : " " + link(file, "CSV"));
  // Beside the table and not in it: a caption in it would be scrolled away with a wide one.
  html_ += folded ? "<details><summary class=\"caption\" id=\"" + id + "\">" + caption + "</summary>\n"
                  : "<p class=\"caption\" id=\"" + id + "\">" + caption + "</p>\n";
  HtmlOptions options;
  options.attributes = " aria-labelledby=\"" + id + "\"";
  options.box = "<div class=\"scroll\" tabindex=\"0\" role=\"region\"" + options.attributes + ">";
  options.rowHeads = true;
  html_ += toHtml(table, options);
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
