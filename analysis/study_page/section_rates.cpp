// SPDX-License-Identifier: BSD-3-Clause
// How often a change was reported: figure and tables of each part, catch trials, published values beside.
#include <fmt/format.h>

#include <algorithm>

#include "analysis/output/text_output.h"
#include "analysis/output/text_table.h"
#include "analysis/study_page/sections.h"

namespace limen::analysis {
namespace {

constexpr size_t kOpenRatesRows = 40;

std::vector<std::string> rateCells(const RateRow& row) {
  const MeanOverSubjects& mean = row.overObservers;
  return {row.text,
          row.change ? row.of : row.of + ", no change",
          std::to_string(mean.subjects),
          percentText(mean.mean),
          mean.standardDeviation ? percentText(*mean.standardDeviation) : "-",
          intervalText(mean.interval, true),
          fmt::format("{}/{}", row.pooled.successes, row.pooled.trials),
          intervalText(row.pooled.wilson, true)};
}

const std::vector<PageTable::Column> kColumns = {
    {"condition", false},    {"rate of", false}, {"observers"},    {"mean"}, {"SD"},
    {"95 % over observers"}, {"pooled"},         {"95 % (Wilson)"}};

/// The whole part, with what was published.
void addPartTable(const StudyPage& page, const StudyPart& part, PageWriter& out) {
  PageTable table;
  table.columns = kColumns;
  bool published = false;
  std::string source;
  for (const RateRow& row : page.rates.rows) {
    if (row.part != part.name || row.scope != RateScope::Part) continue;
    published = published || row.published.has_value();
    if (row.published) source = row.published->source;
  }
  if (published) table.columns.push_back({"published mean (SD)"});
  for (const RateRow& row : page.rates.rows) {
    if (row.part != part.name || row.scope != RateScope::Part) continue;
    table.rows.push_back(rateCells(row));
    if (published)
      table.rows.back().push_back(row.published ? percentText(row.published->mean) + " (" +
                                                      percentText(row.published->sd) + ")"
                                                : "-");
  }
  table.caption = "Detection rates of part " + part.name + ", with and without a change." +
                  (published ? " Published: " + source + "." : "");
  table.file = "tables/rates.csv";
  out.table(table);
}

void addLevelTable(const StudyPage& page, const StudyPart& part, PageWriter& out) {
  PageTable table;
  table.caption = "Detection rates of part " + part.name + " by level of one factor, all others together.";
  table.columns = kColumns;
  table.file = "tables/rates.csv";
  for (const RateRow& row : page.rates.rows)
    if (row.part == part.name && row.scope == RateScope::Level && row.change)
      table.rows.push_back(rateCells(row));
  table.folded = table.rows.size() > kOpenRatesRows;
  out.table(table);
}

/// With a column for each factor.
void addConditionTable(const StudyPage& page, const StudyPart& part, PageWriter& out) {
  PageTable table;
  table.caption = "Detection rates of part " + part.name + " by condition.";
  table.file = "tables/rates.csv";
  for (const StudyFactor& factor : part.factors) table.columns.push_back({factor.name, false});
  table.columns.insert(table.columns.end(), kColumns.begin() + 2, kColumns.end());
  for (const RateRow& row : page.rates.rows) {
    if (row.part != part.name || row.scope != RateScope::Condition || !row.change) continue;
    std::vector<std::string> cells;
    for (const StudyFactor& factor : part.factors) {
      const auto level = row.condition.find(factor.name);
      cells.push_back(level == row.condition.end() ? "" : level->second);
    }
    const std::vector<std::string> rates = rateCells(row);
    cells.insert(cells.end(), rates.begin() + 2, rates.end());
    table.rows.push_back(std::move(cells));
  }
  table.folded = table.rows.size() > kOpenRatesRows;
  out.table(table);
}

}  // namespace

void addRates(const StudyPage& page, PageWriter& out) {
  if (page.rates.rows.empty() && page.rates.notes.empty()) return;
  out.openSection("rates", "Detection rates");
  out.list(page.rates.notes);
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
    addPartTable(page, part, out);
    addLevelTable(page, part, out);
    addConditionTable(page, part, out);
  }
  if (!page.rates.rows.empty()) {
    out.paragraph(
        "Mean, SD and t interval are over observers, of their own rates; the intervals are not cut to 0 and "
        "100 % in the tables. Pooled trials of one observer are not independent, so that the interval of "
        "pooled "
        "trials is too narrow. A dash: cannot be told, or of no width, which is no certainty.");
    out.file("tables/rates.csv", toCsv(page.rates), "detection rates by part, level, condition and observer");
  }
  out.closeSection();
}

}  // namespace limen::analysis
