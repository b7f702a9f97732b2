// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>

#include "analysis/study/thresholds.h"
#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

ResultCell levelIn(const std::map<std::string, std::string>& levels, const std::string& factor) {
  const auto own = levels.find(factor);
  return own == levels.end() ? ResultCell() : ResultCell(own->second);
}

Column valueInterval(const std::string& name, const std::string& title) {
  Column out = interval(name, title, 4);
  out.kind = Kind::Significant;
  return out;
}

ResultTable conditionTable(const PartThresholds& part) {
  TableOf out("conditions",
              part.logarithmic() ? "over observers: geometric means of their thresholds"
                                 : "over observers: means of their thresholds",
              part.conditions);
  out.add(text("condition"), &ThresholdCondition::name);
  for (const std::string& factor : part.factors)
    out.add(forData(text(factor)),
            [&](const ThresholdCondition& one) { return levelIn(one.levels, factor); });
  return out.add(integer("observers"), &ThresholdCondition::observers)
      .add(significant("estimate", "mean threshold"), &ThresholdCondition::mean)
      .add(valueInterval("", "95 % over observers"), &ThresholdCondition::interval)
      .add(ifAny(valueInterval("within", "95 % within observers")), &ThresholdCondition::within)
      .add(number(part.logarithmic() ? "sd_ln" : "sd", part.logarithmic() ? "sd of ln" : "sd"),
           &ThresholdCondition::sd);
}

ResultTable observerTable(const PartThresholds& part, const StudyAnswers& study) {
  const auto condition = [&](const ObserverThreshold& one) -> const ThresholdCondition& {
    return part.conditions[one.condition];
  };
  const auto procedure = [](auto member) { return at(&ObserverThreshold::procedure, member); };
  const std::string name = part.procedure.empty() ? "procedure" : part.procedure;
  TableOf out("thresholds", "of each observer", part.observers);
  out.add(text("observer"), [&](const ObserverThreshold& one) { return study.observers[one.observer]; })
      .add(text("condition"), [&](const ObserverThreshold& one) { return condition(one).name; });
  for (const std::string& factor : part.factors)
    out.add(forData(text(factor)),
            [&](const ObserverThreshold& one) { return levelIn(condition(one).levels, factor); });
  return out.add(integer("trials"), &ObserverThreshold::trials)
      .add(significant("estimate", "threshold"), &ObserverThreshold::value)
      .add(valueInterval("", "95 % (profile)"), &ObserverThreshold::interval)
      .add(forData(flag("low_open")), at(&ObserverThreshold::interval, &FitInterval::lowOpen))
      .add(forData(flag("high_open")), at(&ObserverThreshold::interval, &FitInterval::highOpen))
      .add(ifAny(significant("procedure_estimate", "by " + name)), procedure(&ProcedureEstimate::value))
      .add(ifAny(valueInterval("procedure", "95 %")), procedure(&ProcedureEstimate::interval))
      .add(forData(text("procedure_interval")), procedure(&ProcedureEstimate::kind))
      .add(forData(text("procedure_target")), procedure(&ProcedureEstimate::target))
      .add(ifAny(text("note")), &ObserverThreshold::note);
}

/// Differences of ln thresholds as ratios.
ResultTable pairTable(const PartThresholds& part) {
  struct Row {
    const NamedFactor* factor;
    const PairedComparison* pair;
  };
  std::vector<Row> rows;
  for (size_t f = 0; f < part.anova->comparisons.size(); ++f)
    for (const PairedComparison& pair : part.anova->comparisons[f].pairs)
      rows.push_back({&part.anova->factors[f], &pair});
  const bool ratio = part.logarithmic();
  const auto scaled = [ratio](double value) { return ratio ? std::exp(value) : value; };
  const auto of = [](auto member) { return at(&Row::pair, member); };
  return TableOf("pairs",
                 std::string("pairs of levels, other factors averaged: ") +
                     (ratio ? "ratio of thresholds, first to second" : "difference, first minus second") +
                     "; paired t tests over observers",
                 rows)
      .add(text("factor"), at(&Row::factor, &NamedFactor::name))
      .add(text("first"), [](const Row& row) { return row.factor->levels[row.pair->first]; })
      .add(text("second"), [](const Row& row) { return row.factor->levels[row.pair->second]; })
      .add(significant("estimate", ratio ? "ratio" : "difference"),
           [&](const Row& row) { return scaled(row.pair->difference); })
      .add(valueInterval("", "95 %"),
           [&](const Row& row) {
             return Interval{scaled(row.pair->interval.low), scaled(row.pair->interval.high)};
           })
      .add(forData(flag("is_ratio")), [ratio](const Row&) { return ratio; })
      .add(number("t"), of(&PairedComparison::t))
      .add(significant("df"), of(&PairedComparison::df))
      .add(probability(), of(&PairedComparison::p))
      .add(probability("p_holm", "p (Holm)"), of(&PairedComparison::pHolm))
      .add(number("d_z", "d_z"), of(&PairedComparison::standardisedDifference));
}

std::string targetOf(const PartThresholds& part) {
  for (const ObserverThreshold& one : part.observers)
    if (one.procedure) return one.procedure->target + ", " + one.procedure->kind;
  return "";
}

}  // namespace

Section sectionOf(const PartThresholds& part, const StudyAnswers& study) {
  Section out;
  out.title = "part " + part.part;
  out.fact(key(text("part")), part.part);
  if (!part.note.empty()) {
    out.notes.push_back("no thresholds: " + part.note);
    return out;
  }
  const FitSettings& settings = part.settings;
  out.title += ": thresholds of " + part.title;
  out.fact(forData(text("x")), part.variable);
  out.fact(forData(text("procedure")), part.procedure);
  out.fact(text("sigmoid"), psychometrics::nameOf(settings.sigmoid));
  out.fact(text("axis"), part.logarithmic() ? "log" : "linear");
  out.fact(text("direction"), settings.falling ? "falling" : "rising");
  out.fact(significant("threshold_level", "threshold at F ="), settings.thresholdLevel);
  out.add(conditionTable(part));
  if (part.anova && part.anova->result) {
    ResultTable effects = sectionOf(*part.anova).table("effects");
    effects.title = "repeated-measures analysis of variance of each observer's " + part.anova->measure;
    out.add(std::move(effects));
    out.add(pairTable(part));
  }
  out.add(observerTable(part, study));
  if (part.anova && !part.anova->note.empty()) out.notes.push_back("no tests: " + part.anova->note);
  if (part.anova && !part.anova->incomplete.empty())
    out.notes.push_back("without a threshold in some condition, left out of the tests: " +
                        join(part.anova->incomplete));
  if (const std::string target = targetOf(part); !target.empty())
    out.notes.push_back(fmt::format(
        "by {}: the procedure's own estimate of the threshold at {}, given its prior; means and tests are of "
        "the fitted thresholds",
        part.procedure, target));
  return out;
}

Result resultOf(const std::vector<PartThresholds>& parts, const StudyAnswers& study) {
  Result out;
  out.command = "thresholds";
  for (const PartThresholds& part : parts) out.sections.push_back(sectionOf(part, study));
  out.notes = {
      "thresholds are fitted to each observer's own answers by maximum likelihood; an observer's conditions "
      "share "
      "width, lapse rate and, in yes/no tasks, guess rate",
      "over observers: Student's t interval of their thresholds; within observers: Cousineau-Morey, for "
      "comparing "
      "conditions, says nothing of the mean itself",
      "p (Holm): adjusted over the pairs of a factor"};
  return out;
}

}  // namespace limen::analysis
