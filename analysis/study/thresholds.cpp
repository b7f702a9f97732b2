// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/thresholds.h"

#include <algorithm>
#include <cmath>

#include "analysis/statistics/within_subjects.h"
#include "analysis/study/varying_factors.h"
#include "experiments/base/error.h"
#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

class ThresholdReader {
 public:
  ThresholdReader(const StudyAnswers& study, const FittedPart& whole)
      : study_(study), whole_(whole), plan_(study.plan.parts[whole.part]) {
    out_.part = plan_.name;
    out_.variable = whole.variable;
    out_.title = plan_.titleOf(whole.variable);
    if (plan_.adaptive && plan_.procedure.contains("type") && plan_.procedure["type"].is_string())
      out_.procedure = plan_.procedure["type"];
    out_.settings = ownFitSettings(plan_, whole);
    for (const StudyFactor& factor : plan_.factors)
      if (factor.name != whole.variable) out_.factors.push_back(factor.name);
    for (size_t i = 0; i < whole.conditions.size(); ++i) {
      out_.conditions.push_back({});
      out_.conditions.back().levels = whole.levels[i];
      out_.conditions.back().name = whole.conditions[i].name.empty() ? "all" : whole.conditions[i].name;
    }
  }

  PartThresholds read(const AnovaSettings& settings) {
    for (size_t observer = 0; observer < study_.observers.size(); ++observer) fit(observer);
    summarise();
    test(settings);
    return std::move(out_);
  }

 private:
  double toScale(double threshold) const { return out_.logarithmic() ? std::log(threshold) : threshold; }
  double fromScale(double value) const { return out_.logarithmic() ? std::exp(value) : value; }
  Interval fromScale(const Interval& interval) const {
    return {fromScale(interval.low), fromScale(interval.high)};
  }

  void fit(size_t observer) {
    StudyAnswers own;
    own.plan = study_.plan;
    own.observers = study_.observers;
    for (const StudyAnswer& answer : study_.answers)
      if (answer.observer == observer && answer.part == whole_.part) own.answers.push_back(answer);
    if (own.answers.empty()) return;
    const FittedPart part = fittedParts(own, whole_.choice).front();
    std::string why;
    Fit fit;
    FitIntervals intervals;
    FitSettings settings = out_.settings;
    shareAllButThreshold(settings, part.conditions.size());
    try {
      fit = fitPsychometric(part.conditions, settings);
      intervals = profileIntervals(part.conditions, fit, 0.95);
    } catch (const Error& error) {
      why = error.message();
    }
    for (size_t i = 0; i < part.conditions.size(); ++i) {
      const auto same =
          std::find_if(whole_.conditions.begin(), whole_.conditions.end(),
                       [&](const Condition& one) { return one.name == part.conditions[i].name; });
      ObserverThreshold one;
      one.observer = observer;
      one.condition = static_cast<size_t>(same - whole_.conditions.begin());
      for (const Block& block : part.conditions[i].blocks) one.trials += block.trials;
      one.note = why;
      try {
        one.procedure = estimate(own, part.levels[i]);
      } catch (const Error& error) {
        one.note += (one.note.empty() ? "" : "; ") + out_.procedure + ": " + error.message();
      }
      if (why.empty()) take(fit.conditions[i], intervals.conditions[i], one);
      out_.observers.push_back(std::move(one));
    }
  }

  static void take(const ConditionFit& fit, const ConditionIntervals& intervals, ObserverThreshold& out) {
    constexpr size_t kThreshold = static_cast<size_t>(FitParameter::Threshold);
    if (fit.atBound[kThreshold] != 0) {
      out.note += (out.note.empty() ? "" : "; ") +
                  std::string("the answers set no threshold: the fit ends at a bound");
      return;
    }
    out.value = fit.values[kThreshold];
    out.interval = intervals[kThreshold];
  }

  std::optional<ProcedureEstimate> estimate(const StudyAnswers& own, const ConditionLevels& levels) const {
    std::vector<const StudyAnswer*> answers;
    for (const StudyAnswer& answer : own.answers)
      if (answer.change && std::all_of(levels.begin(), levels.end(), [&](const auto& level) {
            const auto found = answer.condition.find(level.first);
            return found != answer.condition.end() && found->second == level.second;
          }))
        answers.push_back(&answer);
    StudyAnswers context;
    context.plan = study_.plan;
    context.observers = study_.observers;
    context.leftOut = study_.leftOut;
    return procedureEstimate(context, whole_.part, answers);
  }

  void summarise() {
    for (size_t c = 0; c < out_.conditions.size(); ++c) {
      std::vector<double> values;
      for (const ObserverThreshold& one : out_.observers)
        if (one.condition == c && one.value) values.push_back(toScale(*one.value));
      ThresholdCondition& condition = out_.conditions[c];
      condition.observers = values.size();
      if (values.empty()) continue;
      const MeanOverSubjects mean = meanOverSubjects(values);
      condition.mean = fromScale(mean.mean);
      if (mean.interval) condition.interval = fromScale(*mean.interval);
      condition.sd = mean.standardDeviation;
    }
    // By condition, of the observers who have all.
    std::vector<std::vector<double>> complete(out_.conditions.size());
    for (size_t observer = 0; observer < study_.observers.size(); ++observer) {
      std::vector<double> own;
      for (const ObserverThreshold& one : out_.observers)
        if (one.observer == observer && one.value) own.push_back(toScale(*one.value));
      if (own.size() == complete.size())
        for (size_t c = 0; c < own.size(); ++c) complete[c].push_back(own[c]);
    }
    const auto within = withinSubjectIntervals(complete);
    // Where some lack a condition the interval would surround another mean.
    for (size_t c = 0; c < within.size(); ++c)
      if (within[c] && complete[c].size() == out_.conditions[c].observers)
        out_.conditions[c].within = fromScale(*within[c]);
  }

  void test(const AnovaSettings& settings) {
    std::vector<ConditionLevels> conditions;
    for (const ThresholdCondition& one : out_.conditions) conditions.push_back(one.levels);
    GroupObservations data{varyingFactors(plan_, conditions), study_.observers, {}};
    if (data.factors.empty()) return;
    PartAnova anova;
    anova.part = plan_.name;
    anova.of = whole_.variable;
    anova.rates = false;
    anova.measure = (out_.logarithmic() ? "ln threshold of " : "threshold of ") + whole_.variable;
    for (const ObserverThreshold& one : out_.observers)
      if (const auto cell = cellOf(data.factors, out_.conditions[one.condition].levels); cell && one.value)
        data.observations.push_back({one.observer, *cell, toScale(*one.value)});
    analyseGroup(anova, data, settings);
    out_.anova = std::move(anova);
  }

  const StudyAnswers& study_;
  const FittedPart& whole_;
  const StudyPart& plan_;
  PartThresholds out_;
};

PartThresholds thresholdsOf(const StudyAnswers& study, const std::string& part,
                            const AnovaSettings& settings) {
  FittedPartsChoice choice;
  choice.part = part;
  const FittedPart whole = fittedParts(study, choice).front();
  return ThresholdReader(study, whole).read(settings);
}

std::vector<PartThresholds> thresholdsOfAll(const StudyAnswers& study, bool adaptive,
                                            const AnovaSettings& settings) {
  std::vector<PartThresholds> out;
  for (const StudyPart& part : study.plan.parts) {
    if (part.adaptive != adaptive || !part.isBinary() || numericVariables(part).empty()) continue;
    try {
      out.push_back(thresholdsOf(study, part.name, settings));
    } catch (const Error& error) {
      PartThresholds none;
      none.part = part.name;
      none.note = error.message();
      out.push_back(std::move(none));
    }
  }
  return out;
}

}  // namespace

std::vector<PartThresholds> studyThresholds(const StudyAnswers& study, const std::string& part,
                                            const AnovaSettings& settings) {
  if (!part.empty()) return {thresholdsOf(study, part, settings)};
  std::vector<PartThresholds> out = thresholdsOfAll(study, true, settings);
  if (out.empty()) out = thresholdsOfAll(study, false, settings);
  if (out.empty())
    throw Error("no part has a numeric stimulus variable, which thresholds are of", study.plan.name,
                "limen analyse rates says how often observers answered what");
  return out;
}

std::vector<PartThresholds> adaptiveThresholds(const StudyAnswers& study) {
  return thresholdsOfAll(study, true, {});
}

}  // namespace limen::analysis
