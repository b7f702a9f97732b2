// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/analyses.h"

#include "analysis/study/observer_intervals.h"
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

/// As tests/analysis/study/thresholds_test.cpp counts it, of 1000 studies.
constexpr const char* kObserverCoverage =
    "95 % ones held the threshold in 95.8 % of 1000 simulated studies of 8 observers";

}  // namespace

FitAnswer fitPart(const StudyAnswers& study, const FittedPart& part, const FitOptions& typed) {
  const StudyPart& own = study.plan.parts[part.part];
  FitOptions options = optionsOf(typed, own, part);
  const bool pooled = part.pooledObservers > 1;
  if (!options.intervals) options.intervals = pooled ? IntervalMethod::Observers : IntervalMethod::Profile;
  const bool overObservers = pooled && options.intervals == IntervalMethod::Observers;
  if (overObservers) options.intervals = IntervalMethod::None;
  FitAnswer out = answerFit(options, part.conditions);
  if (overObservers) out.intervals = observerIntervals(study, part, out.fit, options.confidence);
  out.part = own.name;
  out.title = own.titleOf(part.variable);
  out.levels = part.levels;
  out.notes = part.notes;
  if (pooled && out.intervals && !overObservers)
    out.notes.push_back(
        "intervals take all answers as independent, which makes them too narrow for several observers");
  if (overObservers)
    out.notes.push_back("intervals take observers as the unit: fits without each, Student's t (" +
                        std::string(kObserverCoverage) + ")");
  return out;
}

std::vector<PartFit> studyFits(const StudyAnswers& study, const std::string& store) {
  FitOptions options;
  options.file = store;
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
