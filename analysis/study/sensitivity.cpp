// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/sensitivity.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "analysis/output/text_table.h"
#include "analysis/output/text_output.h"

namespace limen::analysis {
namespace {

void count(SensitivityRow& row, const StudyAnswer& answer) {
  const int positive = answer.outcome == 1 ? 1 : 0;
  if (answer.change) {
    row.counts.hits += positive;
    ++row.counts.signalTrials;
  } else {
    row.counts.falseAlarms += positive;
    ++row.counts.noiseTrials;
  }
  row.correct += positive;
  ++row.trials;
}

PartSensitivity sensitivityOf(const StudyAnswers& study, size_t index) {
  const StudyPart& part = study.plan.parts[index];
  PartSensitivity out;
  out.part = part.name;
  out.yesNo = part.asksYesNo();
  out.alternatives = part.alternatives;
  std::vector<SensitivityRow> rows(study.observers.size() + 1);
  for (size_t i = 0; i < rows.size(); ++i) {
    rows[i].part = part.name;
    rows[i].observer = i < study.observers.size() ? study.observers[i] : "";
  }
  for (const StudyAnswer& answer : study.answers) {
    if (answer.part != index) continue;
    count(rows[answer.observer], answer);
    count(rows.back(), answer);
  }
  std::vector<double> dPrimes, criteria;
  for (SensitivityRow& row : rows) {
    if (row.trials == 0) continue;
    if (out.yesNo && row.counts.signalTrials > 0 && row.counts.noiseTrials > 0)
      row.yesNo = analyseYesNo(row.counts);
    if (!out.yesNo) row.mAfc = analyseMAfc(row.correct, row.trials, part.alternatives);
    if (!row.observer.empty() && row.yesNo) {
      dPrimes.push_back(row.yesNo->dPrime);
      criteria.push_back(row.yesNo->criterion);
    }
    if (!row.observer.empty() && row.mAfc) dPrimes.push_back(row.mAfc->dPrime);
    out.rows.push_back(row);
  }
  if (!dPrimes.empty()) out.dPrime = meanOverSubjects(dPrimes);
  if (!criteria.empty()) out.criterion = meanOverSubjects(criteria);
  if (!out.dPrime) out.note = "no observer has trials both with and without a change";
  if (part.adaptive)
    out.note += std::string(out.note.empty() ? "" : "; ") +
                "a procedure chose the stimuli: sensitivity over all of them says little";
  return out;
}

std::vector<std::string> yesNoLine(const SensitivityRow& row) {
  std::vector<std::string> out = {row.observer.empty() ? "all together" : row.observer,
                                  fmt::format("{}/{}", row.counts.hits, row.counts.signalTrials),
                                  fmt::format("{}/{}", row.counts.falseAlarms, row.counts.noiseTrials)};
  if (!row.yesNo) {
    out.insert(out.end(), {"-", "-", "-", "-", "-"});
    return out;
  }
  const YesNoSensitivity& s = *row.yesNo;
  out.insert(out.end(), {fixedText(s.dPrime), intervalText(s.dPrimeInterval), fixedText(s.criterion),
                         fixedText(s.lnBeta), fixedText(s.aPrime)});
  return out;
}

}  // namespace

std::vector<PartSensitivity> studySensitivity(const StudyAnswers& study) {
  std::vector<PartSensitivity> out;
  for (size_t part = 0; part < study.plan.parts.size(); ++part) {
    if (std::none_of(study.answers.begin(), study.answers.end(),
                     [&](const StudyAnswer& answer) { return answer.part == part; }))
      continue;
    if (study.plan.parts[part].isBinary()) {
      out.push_back(sensitivityOf(study, part));
    } else {
      out.emplace_back();
      out.back().part = study.plan.parts[part].name;
      out.back().note = "answers are not one of two";
    }
  }
  return out;
}

std::string toText(const std::vector<PartSensitivity>& parts) {
  std::string out;
  for (const PartSensitivity& part : parts) {
    out += "\npart " + part.part + "\n";
    std::vector<std::vector<std::string>> table;
    if (part.yesNo)
      table.push_back({"observer", "hits", "false alarms", "d'", "95 %", "criterion", "ln beta", "A'"});
    else
      table.push_back({"observer", "right", "share", "d'"});
    for (const SensitivityRow& row : part.rows) {
      if (part.yesNo)
        table.push_back(yesNoLine(row));
      else
        table.push_back({row.observer.empty() ? "all together" : row.observer,
                         fmt::format("{}/{}", row.correct, row.trials),
                         percentText(static_cast<double>(row.correct) / static_cast<double>(row.trials)),
                         row.mAfc ? fixedText(row.mAfc->dPrime) : "-"});
    }
    if (!part.rows.empty()) out += alignedText(table, {0});
    if (part.dPrime)
      out += fmt::format("  mean d' over {} observers {}, sd {}, 95 % {}\n", part.dPrime->subjects,
                         fixedText(part.dPrime->mean), fixedText(part.dPrime->standardDeviation),
                         intervalText(part.dPrime->interval));
    if (part.criterion)
      out += fmt::format("  mean criterion {}, sd {}, 95 % {} (above 0: reluctant to say yes)\n",
                         fixedText(part.criterion->mean), fixedText(part.criterion->standardDeviation),
                         intervalText(part.criterion->interval));
    if (!part.note.empty()) out += "  " + part.note + "\n";
  }
  return out;
}

nlohmann::json toJson(const std::vector<PartSensitivity>& parts) {
  nlohmann::json out = nlohmann::json::array();
  const auto mean = [](const std::optional<MeanOverSubjects>& value) -> nlohmann::json {
    if (!value) return {};
    return {{"observers", value->subjects},
            {"mean", value->mean},
            {"sd", numberJson(value->standardDeviation)},
            {"interval", intervalJson(value->interval)}};
  };
  for (const PartSensitivity& part : parts) {
    nlohmann::json rows = nlohmann::json::array();
    for (const SensitivityRow& row : part.rows) {
      nlohmann::json one = {
          {"observer", row.observer.empty() ? nlohmann::json() : nlohmann::json(row.observer)}};
      if (part.yesNo) {
        one["hits"] = row.counts.hits;
        one["signal_trials"] = row.counts.signalTrials;
        one["false_alarms"] = row.counts.falseAlarms;
        one["noise_trials"] = row.counts.noiseTrials;
      } else {
        one["right"] = row.correct;
        one["trials"] = row.trials;
      }
      if (row.yesNo) {
        one["d_prime"] = row.yesNo->dPrime;
        one["d_prime_interval"] = intervalJson(row.yesNo->dPrimeInterval);
        one["criterion"] = row.yesNo->criterion;
        one["ln_beta"] = row.yesNo->lnBeta;
        one["a_prime"] = row.yesNo->aPrime;
      }
      if (row.mAfc) one["d_prime"] = row.mAfc->dPrime;
      rows.push_back(one);
    }
    out.push_back({{"part", part.part},
                   {"yes_no", part.yesNo},
                   {"alternatives", part.alternatives},
                   {"rows", rows},
                   {"d_prime", mean(part.dPrime)},
                   {"criterion", mean(part.criterion)},
                   {"note", part.note}});
  }
  return out;
}

std::string toCsv(const std::vector<PartSensitivity>& parts) {
  std::string out = csvLine({"part", "observer", "hits", "signal_trials", "false_alarms", "noise_trials",
                             "right", "trials", "d_prime", "criterion", "ln_beta", "a_prime"});
  for (const PartSensitivity& part : parts)
    for (const SensitivityRow& row : part.rows) {
      const auto number = [&](bool wanted, int64_t value) { return wanted ? std::to_string(value) : ""; };
      std::optional<double> dPrime, criterion, lnBeta, a;
      if (row.yesNo)
        dPrime = row.yesNo->dPrime, criterion = row.yesNo->criterion, lnBeta = row.yesNo->lnBeta,
        a = row.yesNo->aPrime;
      if (row.mAfc) dPrime = row.mAfc->dPrime;
      out += csvLine({part.part, row.observer, number(part.yesNo, row.counts.hits),
                      number(part.yesNo, row.counts.signalTrials), number(part.yesNo, row.counts.falseAlarms),
                      number(part.yesNo, row.counts.noiseTrials), number(!part.yesNo, row.correct),
                      number(!part.yesNo, row.trials), cellText(dPrime), cellText(criterion),
                      cellText(lnBeta), cellText(a)});
    }
  return out;
}

}  // namespace limen::analysis
