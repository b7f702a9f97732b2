// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/analyses.h"

#include <algorithm>

#include "experiments/base/error.h"
#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

size_t partOf(const StudyAnswers& study, const std::string& name) {
  std::vector<std::string> names;
  std::vector<size_t> places;
  for (size_t part = 0; part < study.plan.parts.size(); ++part)
    if (std::any_of(study.answers.begin(), study.answers.end(),
                    [&](const StudyAnswer& answer) { return answer.part == part && answer.change; })) {
      names.push_back(study.plan.parts[part].name);
      places.push_back(part);
    }
  if (names.empty()) throw Error("no answers to trials with a change", study.plan.name);
  if (name.empty() && names.size() > 1)
    throw Error("the study has several parts: " + join(names), "--part", "name one");
  if (name.empty()) return places[0];
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw Error("no part '" + name + "' with answers", "--part", suggest(name, names));
  return places[static_cast<size_t>(found - names.begin())];
}

}  // namespace

MixedRows studyMixedRows(const StudyAnswers& study, const std::string& name) {
  const size_t index = partOf(study, name);
  const StudyPart& part = study.plan.parts[index];
  if (!part.isBinary()) throw Error("answers are not one of two", "part " + part.name);
  if (part.adaptive)
    throw Error("a procedure chose the stimuli: rates say more of it than of observers", "part " + part.name);
  MixedRows out;
  out.measure = std::string("rate of '") + (part.asksYesNo() ? "yes" : "right") +
                "' in trials with a change, part " + part.name;
  out.group = "observer";
  for (const StudyFactor& factor : part.factors) out.levels[factor.name] = factor.levels;
  std::vector<int> trials;
  for (const StudyAnswer& answer : study.answers) {
    if (answer.part != index || !answer.change) continue;
    out.groups.push_back(study.observers[answer.observer]);
    out.answers.push_back({answer.outcome == 1 ? 1 : 0, 1});
    trials.push_back(answer.trial);
    for (const StudyFactor& factor : part.factors) {
      const auto own = answer.condition.find(factor.name);
      out.columns[factor.name].push_back(own == answer.condition.end() ? "" : own->second);
    }
  }
  out.place = [groups = out.groups, trials](size_t row, const std::string& column) {
    return "observer " + groups[row] + ", trial " + std::to_string(trials[row]) + ", factor '" + column + "'";
  };
  return out;
}

}  // namespace limen::analysis
