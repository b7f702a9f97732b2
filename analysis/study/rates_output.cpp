// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "analysis/output/text_output.h"
#include "analysis/output/text_table.h"
#include "analysis/study/rates.h"

namespace limen::analysis {
namespace {

std::string scopeText(RateScope scope) {
  switch (scope) {
    case RateScope::Part:
      return "part";
    case RateScope::Level:
      return "level";
    case RateScope::Condition:
      break;
  }
  return "condition";
}

nlohmann::json rateJson(const Rate& rate) {
  return {{"positive", rate.successes},
          {"trials", rate.trials},
          {"rate", rate.rate},
          {"wilson", intervalJson(rate.wilson)},
          {"clopper_pearson", intervalJson(rate.clopperPearson)}};
}

std::string ofText(const RateRow& row) {
  return row.change ? row.of : row.of == "yes" ? "false alarm" : row.of + " without change";
}

std::string spreadText(const Spread& spread, bool percent) {
  const auto number = [&](double value) { return percent ? percentText(value) : fixedText(value, 2); };
  return fmt::format("{} (sd {})", number(spread.mean), number(spread.sdOfN));
}

std::string scenariosText(const std::vector<ScenarioSpread>& scenarios) {
  std::vector<std::vector<std::string>> table = {
      {"scenarios", "stimuli", "number", "rate", "severity", "published rate", "severity"}};
  for (const ScenarioSpread& one : scenarios) {
    table.push_back({one.part, one.presentation, std::to_string(one.rate.scenarios),
                     spreadText(one.rate, true), one.severity ? spreadText(*one.severity, false) : "-"});
    const auto& known = one.published;
    table.back().push_back(known ? spreadText({0, known->meanRate, {}, known->sdRate}, true) : "");
    table.back().push_back(known ? spreadText({0, known->meanSeverity, {}, known->sdSeverity}, false) : "");
  }
  return "\n" + alignedText(table, {0, 1}) + "  mean over scenarios with a change, sd by their number\n";
}

nlohmann::json spreadJson(const Spread& spread) {
  return {{"scenarios", spread.scenarios},
          {"mean", spread.mean},
          {"sd", numberJson(spread.sd)},
          {"sd_of_n", spread.sdOfN}};
}

nlohmann::json scenarioJson(const ScenarioSpread& one) {
  nlohmann::json out = {{"part", one.part},
                        {"presentation", one.presentation},
                        {"rate_of", one.of},
                        {"rate", spreadJson(one.rate)},
                        {"severity", one.severity ? spreadJson(*one.severity) : nlohmann::json()},
                        {"published", nullptr}};
  if (const auto& known = one.published)
    out["published"] = {{"mean_rate", known->meanRate},
                        {"sd_rate", known->sdRate},
                        {"mean_severity", known->meanSeverity},
                        {"sd_severity", known->sdSeverity},
                        {"remark", known->remark},
                        {"source", known->source}};
  return out;
}

}  // namespace

std::string toText(const StudyRates& rates) {
  std::string out;
  std::string part;
  std::vector<std::vector<std::string>> table;
  const auto flush = [&] {
    if (!table.empty()) out += "\npart " + part + "\n" + alignedText(table, {0, 1, 8});
    table.clear();
  };
  for (const RateRow& row : rates.rows) {
    if (row.part != part) flush();
    part = row.part;
    if (table.empty())
      table.push_back({"condition", "rate of", "observers", "mean", "sd", "95 % over observers", "pooled",
                       "95 % (Wilson)", "published"});
    const MeanOverSubjects& mean = row.overObservers;
    table.push_back(
        {row.text, ofText(row), std::to_string(mean.subjects), percentText(mean.mean),
         mean.standardDeviation ? percentText(*mean.standardDeviation) : "-",
         intervalText(mean.interval, true), fmt::format("{}/{}", row.pooled.successes, row.pooled.trials),
         intervalText(row.pooled.wilson, true),
         row.published
             ? fmt::format("{} (sd {})", percentText(row.published->mean), percentText(row.published->sd))
             : ""});
  }
  flush();
  for (const ObserverRate& one : rates.observers) {
    if (one.part != part || table.empty()) {
      if (!table.empty()) out += "\nobservers, part " + part + "\n" + alignedText(table, {0});
      table.clear();
      part = one.part;
      table.push_back({"observer", one.of, "rate", "95 % (Wilson)", "catch trials", "rate", "95 % (Wilson)"});
    }
    std::vector<std::string> line = {one.observer,
                                     fmt::format("{}/{}", one.change.successes, one.change.trials),
                                     percentText(one.change.rate), intervalText(one.change.wilson, true)};
    if (one.catches) {
      line.push_back(fmt::format("{}/{}", one.catches->successes, one.catches->trials));
      line.push_back(percentText(one.catches->rate));
      line.push_back(intervalText(one.catches->wilson, true));
    } else {
      line.insert(line.end(), {"-", "-", "-"});
    }
    table.push_back(line);
  }
  if (!table.empty()) out += "\nobservers, part " + part + "\n" + alignedText(table, {0});
  if (!rates.scenarios.empty()) out += scenariosText(rates.scenarios);
  for (const std::string& note : rates.notes) out += note + "\n";
  out +=
      "\nOver observers: mean, sd and t interval of their own rates, not cut to 0 and 100 %. Pooled trials "
      "of one "
      "observer\nare not independent: their interval is too narrow.\n";
  return out;
}

nlohmann::json toJson(const StudyRates& rates) {
  nlohmann::json rows = nlohmann::json::array(), observers = nlohmann::json::array(),
                 scenarios = nlohmann::json::array();
  for (const RateRow& row : rates.rows)
    rows.push_back({{"part", row.part},
                    {"scope", scopeText(row.scope)},
                    {"condition", row.condition},
                    {"change", row.change},
                    {"rate_of", row.of},
                    {"observers", row.overObservers.subjects},
                    {"mean", row.overObservers.mean},
                    {"sd", numberJson(row.overObservers.standardDeviation)},
                    {"interval", intervalJson(row.overObservers.interval)},
                    {"pooled", rateJson(row.pooled)},
                    {"published", row.published ? nlohmann::json{{"mean", row.published->mean},
                                                                 {"sd", row.published->sd},
                                                                 {"source", row.published->source}}
                                                : nlohmann::json()}});
  for (const ObserverRate& one : rates.observers)
    observers.push_back({{"part", one.part},
                         {"observer", one.observer},
                         {"rate_of", one.of},
                         {"change", rateJson(one.change)},
                         {"catch", one.catches ? rateJson(*one.catches) : nlohmann::json()}});
  for (const ScenarioSpread& one : rates.scenarios) scenarios.push_back(scenarioJson(one));
  return {{"rates", rows}, {"by_observer", observers}, {"over_scenarios", scenarios}, {"notes", rates.notes}};
}

std::string toCsv(const StudyRates& rates) {
  std::string out = csvLine({"part", "scope", "condition", "change", "rate_of", "observers", "mean", "sd",
                             "low", "high", "positive", "trials", "wilson_low", "wilson_high"});
  for (const RateRow& row : rates.rows) {
    const MeanOverSubjects& mean = row.overObservers;
    const auto bound = [&](bool high) {
      return mean.interval ? std::optional<double>(high ? mean.interval->high : mean.interval->low)
                           : std::nullopt;
    };
    out += csvLine({row.part, scopeText(row.scope), row.text, row.change ? "1" : "0", row.of,
                    std::to_string(mean.subjects), cellText(mean.mean), cellText(mean.standardDeviation),
                    cellText(bound(false)), cellText(bound(true)), std::to_string(row.pooled.successes),
                    std::to_string(row.pooled.trials), cellText(row.pooled.wilson.low),
                    cellText(row.pooled.wilson.high)});
  }
  for (const ObserverRate& one : rates.observers)
    for (const bool change : {true, false}) {
      if (!change && !one.catches) continue;
      const Rate& rate = change ? one.change : *one.catches;
      out += csvLine({one.part, "observer", one.observer, change ? "1" : "0", one.of, "1",
                      cellText(rate.rate), "", "", "", std::to_string(rate.successes),
                      std::to_string(rate.trials), cellText(rate.wilson.low), cellText(rate.wilson.high)});
    }
  return out;
}

}  // namespace limen::analysis
