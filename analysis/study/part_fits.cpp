// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/analyses.h"

#include "experiments/base/error.h"

namespace limen::analysis {
namespace {

/// What was not typed is what the protocol says.
FitOptions optionsOf(const FitOptions& typed, const StudyPart& part, const FittedPart& fitted) {
  FitOptions own = typed;
  own.level = fitted.variable;
  own.settings.task = fitted.task;
  if (fitted.guess) own.settings.fixed[indexOf(FitParameter::Guess)] = fitted.guess;
  const auto fill = [](std::string& option, const std::string& value) {
    if (option.empty()) option = value;
  };
  if (part.assumed && part.assumed->variable == fitted.variable) {
    fill(own.sigmoid, part.assumed->sigmoid);
    fill(own.axis, part.assumed->axis);
    fill(own.direction, part.assumed->direction);
    if (!own.thresholdLevel) own.thresholdLevel = part.assumed->level;
  }
  fill(own.direction, "auto");
  return own;
}

}  // namespace

FitAnswer fitPart(const StudyAnswers& study, const FittedPart& part, const FitOptions& typed) {
  const StudyPart& own = study.plan.parts[part.part];
  FitAnswer out = answerFit(optionsOf(typed, own, part), part.conditions);
  out.part = own.name;
  out.notes = part.notes;
  return out;
}

std::vector<PartFit> studyFits(const StudyAnswers& study, const std::string& store) {
  FitOptions options;
  options.file = store;
  options.intervals = IntervalMethod::Profile;
  std::vector<PartFit> out;
  for (const StudyPart& part : study.plan.parts) {
    if (!part.isBinary() || numericVariables(part).empty()) continue;
    PartFit one;
    one.part = part.name;
    FittedPartsChoice choice;
    choice.part = part.name;
    try {
      one.answer = fitPart(study, fittedParts(study, choice).front(), options);
    } catch (const Error& error) {
      one.note = error.message();
    }
    out.push_back(std::move(one));
  }
  return out;
}

}  // namespace limen::analysis
