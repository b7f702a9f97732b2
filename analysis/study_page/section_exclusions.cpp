// SPDX-License-Identifier: BSD-3-Clause
// What was left out, by which rule, and what the rates are with it.
#include <fmt/format.h>

#include <algorithm>

#include "analysis/output/result_data.h"
#include "analysis/output/text_table.h"
#include "analysis/study/head.h"
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
  out.table(ruleTable(study), "Rules that the protocol declares.");
  if (study.leftOut.empty()) {
    out.paragraph("Nothing was left out.");
    out.closeSection();
    return;
  }
  const ResultTable left = leftOutTable(study);
  out.file("tables/left_out.csv", toCsv(left), "what was left out");
  out.table(left, "What was left out.", "tables/left_out.csv", 12);
  std::vector<RateRow> rows;
  for (const RateRow& row : page.allRates.rows)
    if (row.scope == RateScope::Part) rows.push_back(row);
  const auto own = [&](auto member) {
    return [&, member](const RateRow& row) {
      const RateRow* analysed = wholePart(page.rates, row);
      return analysed ? ResultCell(analysed->overObservers.*member) : ResultCell();
    };
  };
  const auto all = [](auto member) {
    return [member](const RateRow& row) { return row.overObservers.*member; };
  };
  out.table(TableOf("exclusions", "", rows)
                .add(text("part"), &RateRow::part)
                .add(text("rate_of"),
                     [](const RateRow& row) { return row.change ? row.of : row.of + ", no change"; })
                .add(integer("observers"), own(&MeanOverSubjects::subjects))
                .add(share("estimate", "as analysed"), own(&MeanOverSubjects::mean))
                .add(share("sd", "SD"), own(&MeanOverSubjects::standardDeviation))
                .add(integer("all_observers", "observers"), all(&MeanOverSubjects::subjects))
                .add(share("all_estimate", "nothing excluded"), all(&MeanOverSubjects::mean))
                .add(share("all_sd", "SD"), all(&MeanOverSubjects::standardDeviation)),
            "Detection rates as analysed and with nothing excluded: mean over observers of their own rates, "
            "SD over "
            "observers.");
  out.file("tables/rates_nothing_excluded.csv", toCsv(resultOf(page.allRates).sections),
           "detection rates with nothing excluded");
  out.closeSection();
}

}  // namespace limen::analysis
