// SPDX-License-Identifier: BSD-3-Clause
// How often a change was reported: figure and tables of each part, catch trials, published values beside.
#include <fmt/format.h>

#include <algorithm>

#include "analysis/output/result_data.h"
#include "analysis/output/result_text.h"
#include "analysis/output/text_output.h"
#include "analysis/study_page/sections.h"

namespace limen::analysis {
namespace {

/// The rows of one scope; catch trials only of the whole part.
ResultTable rowsOf(const ResultTable& rates, const std::string& scope) {
  ResultTable out = rates;
  for (Column& column : out.columns) column.cells.clear();
  for (size_t row = 0; row < rates.rows(); ++row) {
    std::string own;
    bool change = true;
    for (const Column& column : rates.columns) {
      if (column.name == "scope") own = cellText(column, column.cells[row]);
      if (column.name == "change") change = std::get<bool>(column.cells[row].value());
    }
    if (own != scope || !(change || scope == "part")) continue;
    for (size_t i = 0; i < out.columns.size(); ++i)
      out.columns[i].cells.push_back(rates.columns[i].cells[row]);
  }
  return out;
}

void addTables(const std::string& part, const Section& section, PageWriter& out) {
  const ResultTable& rates = section.table("rates");
  for (const auto& [scope, what] : {std::pair{"part", ", with and without a change."},
                                    std::pair{"level", " by level of one factor, all others together."},
                                    std::pair{"condition", " by condition."}})
    out.table(rowsOf(rates, scope), "Detection rates of part " + part + what, "tables/rates.csv");
}

}  // namespace

void addRates(const StudyPage& page, PageWriter& out) {
  if (page.rates.rows.empty() && page.rates.notes.empty()) return;
  out.openSection("rates", "Detection rates");
  out.list(page.rates.notes);
  const Result result = resultOf(page.rates);
  for (const StudyPart& part : page.study.plan.parts) {
    if (std::none_of(page.rates.rows.begin(), page.rates.rows.end(),
                     [&](const RateRow& row) { return row.part == part.name; }))
      continue;
    if (page.study.plan.parts.size() > 1) out.heading("Part " + part.name);
    if (std::optional<Figure> figure = rateFigure(page, part)) {
      const std::string caption = fmt::format(
          "Part {}: {} by {}. Mean over {} of their own rates; bars are 95 % t intervals over observers, cut "
          "to "
          "0 and 100 % in the drawing.",
          part.name, part.asksYesNo() ? "reported changes" : "right answers", figure->xTitle,
          counted(page.study.observers.size(), "observer"));
      out.figure(std::move(*figure), caption);
    }
    const auto section =
        std::find_if(result.sections.begin(), result.sections.end(),
                     [&](const Section& one) { return one.title == "part " + part.name; });
    addTables(part.name, *section, out);
  }
  if (!page.rates.rows.empty()) {
    out.paragraph(
        "Mean, SD and t interval are over observers, of their own rates; the intervals are not cut to 0 and "
        "100 % in the tables. Pooled trials of one observer are not independent, so that the interval of "
        "pooled "
        "trials is too narrow. A dash: cannot be told, or of no width, which is no certainty.");
    out.file("tables/rates.csv", toCsv(result.sections), "detection rates by part, level, condition and observer");
  }
  out.closeSection();
}

}  // namespace limen::analysis
