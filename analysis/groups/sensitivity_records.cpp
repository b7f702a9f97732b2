// SPDX-License-Identifier: BSD-3-Clause
// Signal detection as JSON and CSV.
#include <nlohmann/json.hpp>

#include "analysis/groups/sensitivity.h"
#include "analysis/output/text_output.h"
#include "analysis/output/text_table.h"

namespace limen::analysis {
namespace {

using nlohmann::json;

json meanJson(const std::optional<MeanOverSubjects>& value) {
  if (!value) return {};
  return {{"observers", value->subjects},
          {"mean", value->mean},
          {"sd", numberJson(value->standardDeviation)},
          {"interval", intervalJson(value->interval)}};
}

json rowJson(const PartSensitivity& part, const SensitivityRow& row) {
  json out = {{"observer", row.observer.empty() ? json() : json(row.observer)}};
  if (part.yesNo) {
    out["hits"] = row.counts.hits;
    out["signal_trials"] = row.counts.signalTrials;
    out["false_alarms"] = row.counts.falseAlarms;
    out["noise_trials"] = row.counts.noiseTrials;
  } else {
    out["right"] = row.correct;
    out["trials"] = row.trials;
  }
  if (row.yesNo) {
    const YesNoSensitivity& s = *row.yesNo;
    out["hit_rate"] = s.hitRate;
    out["false_alarm_rate"] = s.falseAlarmRate;
    out["d_prime"] = s.dPrime;
    out["d_prime_interval"] = intervalJson(s.dPrimeInterval);
    out["criterion"] = s.criterion;
    out["criterion_interval"] = intervalJson(s.criterionInterval);
    out["ln_beta"] = s.lnBeta;
    out["ln_beta_interval"] = intervalJson(s.lnBetaInterval);
    out["beta"] = numberJson(s.beta);
    out["beta_interval"] = intervalJson(s.betaInterval);
    out["a_prime"] = s.aPrime;
    out["a_prime_interval"] = intervalJson(s.aPrimeInterval);
  }
  if (row.mAfc) {
    out["proportion_correct"] = row.mAfc->proportionCorrect;
    out["d_prime"] = row.mAfc->dPrime;
    out["d_prime_interval"] = json::array({numberJson(row.mAfc->low), numberJson(row.mAfc->high)});
  }
  return out;
}

/// The value, then low and high.
void addCells(std::vector<std::string>& fields, const std::optional<double>& value,
              const std::optional<double>& low, const std::optional<double>& high) {
  fields.insert(fields.end(), {cellText(value), cellText(low), cellText(high)});
}

std::vector<std::string> rowCells(const PartSensitivity& part, const SensitivityRow& row) {
  const auto number = [](bool wanted, int64_t value) { return wanted ? std::to_string(value) : ""; };
  std::vector<std::string> out = {part.part,
                                  row.observer,
                                  number(part.yesNo, row.counts.hits),
                                  number(part.yesNo, row.counts.signalTrials),
                                  number(part.yesNo, row.counts.falseAlarms),
                                  number(part.yesNo, row.counts.noiseTrials),
                                  number(!part.yesNo, row.correct),
                                  number(!part.yesNo, row.trials)};
  if (row.yesNo) {
    const YesNoSensitivity& s = *row.yesNo;
    addCells(out, s.dPrime, s.dPrimeInterval.low, s.dPrimeInterval.high);
    addCells(out, s.criterion, s.criterionInterval.low, s.criterionInterval.high);
    addCells(out, s.lnBeta, s.lnBetaInterval.low, s.lnBetaInterval.high);
    addCells(out, s.beta, s.betaInterval.low, s.betaInterval.high);
    addCells(out, s.aPrime, s.aPrimeInterval.low, s.aPrimeInterval.high);
  } else if (row.mAfc) {
    addCells(out, row.mAfc->dPrime, row.mAfc->low, row.mAfc->high);
  }
  return out;
}

}  // namespace

json toJson(const std::vector<PartSensitivity>& parts) {
  json out = json::array();
  for (const PartSensitivity& part : parts) {
    json rows = json::array();
    for (const SensitivityRow& row : part.rows) rows.push_back(rowJson(part, row));
    out.push_back({{"part", part.part.empty() ? json() : json(part.part)},
                   {"yes_no", part.yesNo},
                   {"alternatives", part.alternatives},
                   {"correction", part.correction == RateCorrection::kLogLinear ? "loglinear" : "none"},
                   {"rows", rows},
                   {"d_prime", meanJson(part.dPrime)},
                   {"criterion", meanJson(part.criterion)},
                   {"ln_beta", meanJson(part.lnBeta)},
                   {"a_prime", meanJson(part.aPrime)},
                   {"note", part.note}});
  }
  return out;
}

std::string toCsv(const std::vector<PartSensitivity>& parts) {
  std::vector<std::string> columns = {"part",         "observer",     "hits",  "signal_trials",
                                      "false_alarms", "noise_trials", "right", "trials"};
  for (const std::string name : {"d_prime", "criterion", "ln_beta", "beta", "a_prime"})
    columns.insert(columns.end(), {name, name + "_low", name + "_high"});
  std::string out = csvLine(columns);
  for (const PartSensitivity& part : parts)
    for (const SensitivityRow& row : part.rows) {
      std::vector<std::string> cells = rowCells(part, row);
      cells.resize(columns.size());
      out += csvLine(cells);
    }
  return out;
}

}  // namespace limen::analysis
