// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/lapse_rule.h"

#include "analysis/psychometric/fit.h"
#include "analysis/study/fitted_parts.h"
#include "experiments/base/error.h"
#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

/// Quantile of chi-squared with one degree of freedom that a one-sided test of 5 % takes: 1.6449^2.
constexpr double kTelling = 2.705543454;

/// Rates far above any limit that makes sense have to be in reach.
FitSettings settingsOf(const StudyPart& part, const FittedPart& fitted) {
  FitSettings settings = ownFitSettings(part, fitted);
  settings.lapseMost =
      0.9 * (fitted.task.kind == FitTask::Kind::ForcedChoice ? 1.0 - 1.0 / fitted.task.alternatives
                                                             : 1.0 - settings.guessMost);
  return settings;
}

ObserverLapse lapseOf(const std::vector<Condition>& conditions, FitSettings settings, double limit) {
  shareAllButThreshold(settings, conditions.size());
  const Fit free = fitPsychometric(conditions, settings);
  settings.fixed[indexOf(FitParameter::Lapse)] = limit;
  shareAllButThreshold(settings, conditions.size());
  const Fit held = fitPsychometric(conditions, settings);
  ObserverLapse out;
  out.rate = free.conditions[0].value(FitParameter::Lapse);
  out.statistic = likelihoodRatio(held, free).statistic;
  if (out.statistic > kTelling)
    out.verdict = *out.rate > limit ? ObserverLapse::Verdict::Above : ObserverLapse::Verdict::Below;
  return out;
}

/// Above goes before below, and that before what tells nothing.
void take(const ObserverLapse& part, ObserverLapse& out) {
  if (!out.rate || part.verdict > out.verdict) out = part;
}

}  // namespace

LapseRates lapseRates(const StudyAnswers& study, double limit) {
  LapseRates out;
  out.observers.resize(study.observers.size());
  std::vector<StudyAnswers> own(study.observers.size());
  for (StudyAnswers& one : own) {
    one.plan = study.plan;
    one.observers = study.observers;
  }
  for (const StudyAnswer& answer : study.answers) own[answer.observer].answers.push_back(answer);
  std::vector<std::string> reasons;
  bool fitted = false;
  for (const StudyPart& part : study.plan.parts) {
    FittedPartsChoice choice;
    choice.part = part.name;
    FitSettings settings;
    try {
      settings = settingsOf(part, fittedParts(study, choice).front());
    } catch (const Error& error) {
      reasons.push_back(error.where() + ": " + error.message());
      continue;
    }
    fitted = true;
    for (size_t i = 0; i < own.size(); ++i) {
      try {
        take(lapseOf(fittedParts(own[i], choice).front().conditions, settings, limit), out.observers[i]);
      } catch (const Error&) {
        // No answers to this part, or one level alone: they tell nothing.
      }
    }
  }
  if (!fitted) out.why = "no part has a function to fit: " + join(reasons, "; ");
  return out;
}

}  // namespace limen::analysis
