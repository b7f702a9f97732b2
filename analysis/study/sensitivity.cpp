// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/analyses.h"

#include <algorithm>

namespace limen::analysis {
namespace {

void countAnswer(SensitivityRow& row, const StudyAnswer& answer) {
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

void sensitivityOf(PartSensitivity& out, const StudyAnswers& study, size_t index) {
  const StudyPart& part = study.plan.parts[index];
  out.yesNo = part.asksYesNo();
  out.alternatives = part.alternatives;
  std::vector<SensitivityRow> rows(study.observers.size() + 1);
  for (size_t i = 0; i < rows.size(); ++i) {
    rows[i].part = part.name;
    rows[i].observer = i < study.observers.size() ? study.observers[i] : "";
  }
  for (const StudyAnswer& answer : study.answers) {
    if (answer.part != index) continue;
    countAnswer(rows[answer.observer], answer);
    countAnswer(rows.back(), answer);
  }
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(out.rows),
               [](const SensitivityRow& row) { return row.trials > 0; });
  analyseSensitivity(out);
  if (!out.dPrime) out.note = "no observer has trials both with and without a change";
  if (part.adaptive)
    out.note += std::string(out.note.empty() ? "" : "; ") +
                "a procedure chose the stimuli: sensitivity over all of them says little";
}

}  // namespace

std::vector<PartSensitivity> studySensitivity(const StudyAnswers& study, RateCorrection correction) {
  std::vector<PartSensitivity> out;
  for (size_t part = 0; part < study.plan.parts.size(); ++part) {
    if (std::none_of(study.answers.begin(), study.answers.end(),
                     [&](const StudyAnswer& answer) { return answer.part == part; }))
      continue;
    out.emplace_back();
    out.back().part = study.plan.parts[part].name;
    out.back().title = "part " + out.back().part;
    out.back().correction = correction;
    if (study.plan.parts[part].isBinary())
      sensitivityOf(out.back(), study, part);
    else
      out.back().note = "answers are not one of two";
  }
  return out;
}

}  // namespace limen::analysis
