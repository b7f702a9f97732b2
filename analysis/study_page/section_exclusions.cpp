// SPDX-License-Identifier: BSD-3-Clause
// What was left out, by which rule, and what the rates are with it.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "analysis/output/text_output.h"
#include "analysis/output/text_table.h"
#include "analysis/study_page/sections.h"
#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

const RateRow* wholePart(const StudyRates& rates, const RateRow& like) {
  const auto found = std::find_if(rates.rows.begin(), rates.rows.end(), [&](const RateRow& row) {
    return row.scope == RateScope::Part && row.part == like.part && row.change == like.change;
  });
  return found == rates.rows.end() ? nullptr : &*found;
}

std::string rateText(const RateRow* row) {
  if (!row) return "-";
  const MeanOverSubjects& mean = row->overObservers;
  return percentText(mean.mean) +
         (mean.standardDeviation ? " (" + percentText(*mean.standardDeviation) + ")" : "");
}

void addRules(const StudyAnswers& study, PageWriter& out) {
  PageTable table;
  table.caption = "Rules that the protocol declares.";
  table.columns = {{"rule", false}, {"limit"}, {"applied", false}, {"observers"}, {"answers"}};
  for (const AppliedRule& rule : study.rules) {
    std::set<std::string> observers;
    size_t answers = 0;
    for (const LeftOut& left : study.leftOut)
      if (left.rule == rule.name) {
        observers.insert(left.observer);
        answers += left.answers;
      }
    table.rows.push_back({rule.name, shortestNumber(rule.limit), rule.applied ? "yes" : "no: " + rule.note,
                          rule.applied ? std::to_string(observers.size()) : "-",
                          rule.applied ? std::to_string(answers) : "-"});
  }
  out.table(table);
}

}  // namespace

std::string ruleText(const std::string& rule, double limit) {
  if (rule == "catch_rate_above")
    return fmt::format("observers who said yes in more than {} of their trials without a change",
                       percentText(limit));
  if (rule == "lapse_above")
    return fmt::format("observers with a fitted lapse rate above {}", percentText(limit));
  if (rule == "reaction_time_below_s")
    return fmt::format("answers given less than {} s after the question", shortestNumber(limit));
  if (rule == "reaction_time_above_s")
    return fmt::format("answers given more than {} s after the question", shortestNumber(limit));
  return fmt::format("what the rule {} ({}) names", rule, shortestNumber(limit));
}

void addExclusions(const StudyPage& page, PageWriter& out) {
  const StudyAnswers& study = page.study;
  out.openSection("exclusions", "What was left out");
  if (study.rules.empty()) out.paragraph("The protocol declares no exclusion rules.");
  addRules(study, out);
  PageTable table;
  table.caption = "What was left out.";
  table.columns = {{"observer", false}, {"by", false}, {"answers"}, {"detail", false}};
  table.file = "tables/left_out.csv";
  table.folded = study.leftOut.size() > 12;
  std::string csv = csvLine({"observer", "rule", "answers", "detail"});
  for (const LeftOut& left : study.leftOut) {
    table.rows.push_back({left.observer, left.rule, std::to_string(left.answers), left.detail});
    csv += csvLine({left.observer, left.rule, std::to_string(left.answers), left.detail});
  }
  if (study.leftOut.empty()) {
    out.paragraph("Nothing was left out.");
    out.closeSection();
    return;
  }
  out.file(table.file, csv, "what was left out");
  out.table(table);
  PageTable both;
  both.caption =
      "Detection rates as analysed and with nothing excluded: mean over observers of their own rates, SD "
      "over "
      "observers in brackets.";
  both.columns = {{"part", false}, {"rate of", false}, {"observers"},
                  {"as analysed"}, {"observers"},      {"nothing excluded"}};
  for (const RateRow& row : page.allRates.rows) {
    if (row.scope != RateScope::Part) continue;
    const RateRow* own = wholePart(page.rates, row);
    both.rows.push_back({row.part, row.change ? row.of : row.of + ", no change",
                         own ? std::to_string(own->overObservers.subjects) : "-", rateText(own),
                         std::to_string(row.overObservers.subjects), rateText(&row)});
  }
  out.table(both);
  out.file("tables/rates_nothing_excluded.csv", toCsv(page.allRates),
           "detection rates with nothing excluded");
  out.closeSection();
}

}  // namespace limen::analysis
