// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/observer_intervals.h"

#include <algorithm>
#include <cmath>

#include "analysis/statistics/detection_rates.h"
#include "analysis/statistics/distributions.h"
#include "experiments/base/error.h"

namespace limen::analysis {
namespace {

/// The scale on which a quantity's error is taken.
struct Scale {
  bool logarithmic = false;
  double sign = 1.0;  ///< of a slope that falls
  double to(double value) const { return logarithmic ? std::log(sign * value) : value; }
  double from(double value) const { return logarithmic ? sign * std::exp(value) : value; }
};

Scale scaleOf(size_t quantity, const Fit& fit, double value) {
  if (quantity == indexOf(FitParameter::Threshold)) return {fit.settings.logarithmic(), 1.0};
  if (quantity == indexOf(FitParameter::Width)) return {true, 1.0};
  if (quantity == kFitParameters) return {value != 0.0, value < 0.0 ? -1.0 : 1.0};
  return {};
}

/// Fits without one observer each, and for which conditions that left out anything.
struct Without {
  std::vector<FitQuantities> quantities;  ///< of each condition of the whole fit
  std::vector<bool> changed;
};

std::optional<Without> withoutObserver(const StudyAnswers& study, const FittedPart& part, const Fit& fit,
                                       size_t observer) {
  StudyAnswers rest;
  rest.plan = study.plan;
  rest.observers = study.observers;
  for (const StudyAnswer& answer : study.answers)
    if (answer.part == part.part && answer.observer != observer) rest.answers.push_back(answer);
  const FittedPart own = fittedParts(rest, part.choice).front();
  FitSettings settings = fit.settings;
  if (own.guess) settings.fixed[indexOf(FitParameter::Guess)] = own.guess;
  const Fit refit = fitPsychometric(own.conditions, settings);
  const bool shares =
      std::any_of(settings.shared.begin(), settings.shared.end(), [](bool one) { return one; });
  Without out;
  for (size_t c = 0; c < fit.conditions.size(); ++c) {
    const auto same =
        std::find_if(refit.conditions.begin(), refit.conditions.end(),
                     [&](const ConditionFit& one) { return one.name == fit.conditions[c].name; });
    const bool gone = same == refit.conditions.end();
    out.quantities.push_back(quantitiesOf(gone ? fit.conditions[c] : *same));
    out.changed.push_back(!gone && (shares || same->trials != fit.conditions[c].trials));
  }
  return out;
}

std::optional<FitInterval> intervalOf(const Fit& fit, size_t c, size_t quantity,
                                      const std::vector<Without>& all, double confidence) {
  const ConditionFit& own = fit.conditions[c];
  const bool parameter = quantity < kFitParameters;
  if (parameter && !own.fitted[quantity]) return {};
  const bool rate = parameter && quantity >= indexOf(FitParameter::Guess);
  if (rate && own.atBound[quantity] != 0) return {};
  const double value = quantitiesOf(own)[quantity];
  const Scale scale = scaleOf(quantity, fit, value);
  std::vector<double> values;
  for (const Without& one : all)
    if (one.changed[c]) values.push_back(scale.to(one.quantities[c][quantity]));
  if (values.size() < 2 ||
      !std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); }))
    return {};
  // Replicates lie (n - 1) times as close together as the observers' own values would.
  const auto n = static_cast<double>(values.size());
  const double error = (n - 1.0) * *meanOverSubjects(values).standardError;
  const double reach = tCritical(1.0 - confidence, n - 1.0) * error;
  FitInterval out;
  out.low = scale.from(scale.to(value) - scale.sign * reach);
  out.high = scale.from(scale.to(value) + scale.sign * reach);
  if (rate) {
    const double most = quantity == indexOf(FitParameter::Lapse)   ? fit.settings.lapseMost
                        : quantity == indexOf(FitParameter::Guess) ? fit.settings.guessMost
                                                                   : 1.0;
    out.lowOpen = out.low < 0.0;
    out.highOpen = out.high > most;
    out.low = std::max(out.low, 0.0);
    out.high = std::min(out.high, most);
  }
  return out;
}

}  // namespace

FitIntervals observerIntervals(const StudyAnswers& study, const FittedPart& part, const Fit& fit,
                               double confidence) {
  FitIntervals out;
  out.method = IntervalMethod::Observers;
  out.confidence = confidence;
  out.conditions.resize(fit.conditions.size());
  std::vector<bool> seen(study.observers.size());
  for (const StudyAnswer& answer : study.answers)
    if (answer.part == part.part) seen[answer.observer] = true;
  std::vector<Without> all;
  for (size_t observer = 0; observer < seen.size(); ++observer) {
    if (!seen[observer]) continue;
    try {
      if (auto one = withoutObserver(study, part, fit, observer)) all.push_back(std::move(*one));
    } catch (const Error& error) {
      out.warnings.push_back("no intervals: the answers of all but " + study.observers[observer] +
                             " cannot be fitted: " + error.message());
      return out;
    }
  }
  for (size_t c = 0; c < fit.conditions.size(); ++c)
    for (size_t quantity = 0; quantity < kFitQuantities; ++quantity)
      out.conditions[c][quantity] = intervalOf(fit, c, quantity, all, confidence);
  return out;
}

}  // namespace limen::analysis
