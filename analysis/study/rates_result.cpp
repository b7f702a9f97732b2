// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/rates.h"

namespace limen::analysis {
namespace {

std::string scopeText(RateScope scope) {
  return scope == RateScope::Part ? "part" : scope == RateScope::Level ? "level" : "condition";
}

std::string ofText(const RateRow& row) {
  return row.change ? row.of : row.of == "yes" ? "false alarm" : row.of + " without change";
}

/// Levels of one factor; none where others take part too or it does not.
ResultTable rateTable(const StudyRates& rates, const std::string& part) {
  std::vector<RateRow> rows;
  std::map<std::string, bool> factors;
  for (const RateRow& row : rates.rows)
    if (row.part == part) {
      rows.push_back(row);
      for (const auto& [factor, level] : row.condition) factors[factor] = true;
    }
  const auto of = [](auto member) { return at(&RateRow::overObservers, member); };
  const auto pooled = [](auto member) { return at(&RateRow::pooled, member); };
  const auto published = [](auto member) { return at(&RateRow::published, member); };
  TableOf out("rates", "", rows);
  out.add(forData(text("scope")), [](const RateRow& row) { return scopeText(row.scope); })
      .add(text("condition"), &RateRow::text);
  for (const auto& [factor, used] : factors)
    out.add(forData(text(factor)), [factor = factor](const RateRow& row) {
      const auto level = row.condition.find(factor);
      return level == row.condition.end() ? ResultCell() : ResultCell(level->second);
    });
  return out.add(forData(flag("change")), &RateRow::change)
      .add(forData(text("rate_of")), &RateRow::of)
      .add(forPeople(text("", "rate of")), ofText)
      .add(integer("observers"), of(&MeanOverSubjects::subjects))
      .add(share("estimate", "mean"), of(&MeanOverSubjects::mean))
      .add(share("sd"), of(&MeanOverSubjects::standardDeviation))
      .add(shareInterval("", "95 % over observers"), of(&MeanOverSubjects::interval))
      .add(ifAny(shareInterval("within", "95 % within observers")), &RateRow::within)
      .add(count("positive", "trials", "pooled"),
           [](const RateRow& row) { return countOf(&Rate::successes, &Rate::trials)(row.pooled); })
      .add(forData(share("pooled_rate")), pooled(&Rate::rate))
      .add(shareInterval("wilson", "95 % (Wilson)"), pooled(&Rate::wilson))
      .add(forData(shareInterval("clopper_pearson")), pooled(&Rate::clopperPearson))
      .add(ifAny(share("published", "published mean")), published(&PublishedRate::mean))
      .add(ifAny(share("published_sd", "published sd")), published(&PublishedRate::sd))
      .add(forData(text("published_source")), published(&PublishedRate::source));
}

ResultTable observerTable(const StudyRates& rates, const std::string& part) {
  struct Row {
    const ObserverRate* own;
    bool change;
    Rate rate;
  };
  std::vector<Row> rows;
  for (const ObserverRate& one : rates.observers) {
    if (one.part != part) continue;
    rows.push_back({&one, true, one.change});
    if (one.catches) rows.push_back({&one, false, *one.catches});
  }
  const auto of = [](auto member) { return at(&Row::rate, member); };
  return TableOf("by_observer", "of each observer", rows)
      .add(text("observer"), at(&Row::own, &ObserverRate::observer))
      .add(forData(flag("change")), &Row::change)
      .add(forPeople(text("", "trials")), [](const Row& row) { return row.change ? "change" : "no change"; })
      .add(text("rate_of"), at(&Row::own, &ObserverRate::of))
      .add(count("positive", "trials", "answers"),
           [](const Row& row) { return countOf(&Rate::successes, &Rate::trials)(row.rate); })
      .add(share("estimate", "rate"), of(&Rate::rate))
      .add(shareInterval("wilson", "95 % (Wilson)"), of(&Rate::wilson))
      .add(forData(shareInterval("clopper_pearson")), of(&Rate::clopperPearson));
}

ResultTable scenarioTable(const StudyRates& rates, const std::string& part) {
  struct Row {
    const ScenarioSpread* own;
    std::string quantity;
    std::optional<Spread> spread;
    std::optional<double> published, publishedSd;
  };
  std::vector<Row> rows;
  for (const ScenarioSpread& one : rates.scenarios) {
    if (one.part != part) continue;
    const auto& known = one.published;
    const auto printed = [&](double PublishedScenarios::*member) {
      return known ? std::optional<double>((*known).*member) : std::nullopt;
    };
    rows.push_back({&one, "rate", one.rate, printed(&PublishedScenarios::meanRate),
                    printed(&PublishedScenarios::sdRate)});
    if (one.severity || known)
      rows.push_back({&one, "severity", one.severity, printed(&PublishedScenarios::meanSeverity),
                      printed(&PublishedScenarios::sdSeverity)});
  }
  const auto of = [](auto member) { return at(&Row::spread, member); };
  const auto known = [](auto member) { return at(&Row::own, &ScenarioSpread::published, member); };
  return TableOf("over_scenarios", "over scenarios with a change: means, and sd by their number", rows)
      .add(text("presentation", "stimuli"), at(&Row::own, &ScenarioSpread::presentation))
      .add(text("quantity"), &Row::quantity)
      .add(forData(text("rate_of")), at(&Row::own, &ScenarioSpread::of))
      .add(integer("scenarios"), of(&Spread::scenarios))
      .add(number("estimate", "mean", 4), of(&Spread::mean))
      .add(number("sd_of_n", "sd", 4), of(&Spread::sdOfN))
      .add(forData(number("sd")), of(&Spread::sd))
      .add(ifAny(number("published", "published mean", 4)), &Row::published)
      .add(ifAny(number("published_sd", "published sd", 4)), &Row::publishedSd)
      .add(forData(text("published_remark")), known(&PublishedScenarios::remark))
      .add(forData(text("published_source")), known(&PublishedScenarios::source));
}

}  // namespace

Result resultOf(const StudyRates& rates) {
  Result out;
  out.command = "rates";
  std::vector<std::string> parts;
  for (const RateRow& row : rates.rows)
    if (parts.empty() || parts.back() != row.part) parts.push_back(row.part);
  for (const std::string& part : parts) {
    Section own;
    own.title = "part " + part;
    own.fact(key(text("part")), part);
    own.add(rateTable(rates, part));
    own.add(observerTable(rates, part));
    own.add(scenarioTable(rates, part));
    out.sections.push_back(std::move(own));
  }
  out.notes = rates.notes;
  out.notes.push_back(
      "over observers: mean and sd of their own rates, t interval on the logit scale, which stays between 0 "
      "and "
      "100 %; within observers: Cousineau-Morey, for comparing levels or conditions. Pooled trials of one "
      "observer "
      "are not independent: their interval is too narrow");
  return out;
}

}  // namespace limen::analysis
