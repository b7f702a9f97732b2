// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/psychometric/fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "analysis/psychometric/objective.h"
#include "analysis/psychometric/optimiser.h"
#include "analysis/statistics/distributions.h"
#include "experiments/base/error.h"

namespace limen::analysis {
namespace {

constexpr size_t kStarts = 6;

/// Where the objective is flat up to a bound (every answer correct, answers that change within one step), the
/// bound is the answer, so that it does not depend on where the search ended, and is known for what it is.
void settle(const Objective& objective, Optimum& optimum) {
  constexpr double kFlat = 1e-7;
  if (!std::isfinite(optimum.value)) return;
  for (size_t j = 0; j < objective.size(); ++j) {
    const FreeParameter& free = objective.free()[j];
    // What is as good as at a bound is there. Rates that tell nothing are 0, never as large as they may be.
    const int reached = optimum.atBound[j];
    for (const int side : {-1, 1}) {
      if (reached != 0 ? side != reached : isRate(free.parameter) && side > 0) continue;
      std::vector<double> x = optimum.x;
      x[j] = side < 0 ? free.low : free.high;
      const double value = objective.evaluate(x.data(), nullptr);
      if (!(value <= optimum.value + kFlat)) continue;
      optimum.x = x;
      optimum.value = value;
      optimum.atBound[j] = side;
      break;
    }
  }
}

Optimum best(const Objective& objective, const std::vector<std::vector<double>>& starts) {
  Optimum found;
  found.value = std::numeric_limits<double>::infinity();
  for (const std::vector<double>& start : starts) {
    Optimum optimum = minimise(objective, start);
    if (found.x.empty() || optimum.value < found.value) found = std::move(optimum);
  }
  settle(objective, found);
  return found;
}

Optimum optimumOfOne(const Condition& condition, const FitSettings& settings) {
  const Objective objective({condition}, settings);
  return best(objective, startsOf(objective, kStarts));
}

/// Starts of a design: each condition is fitted by itself; then what is shared takes the value of each of
/// them, and the mean, and the rest of every condition is fitted to that.
std::vector<std::vector<double>> startsOfDesign(const std::vector<Condition>& conditions,
                                                const Objective& joint) {
  constexpr size_t kMost = 5;
  const FitSettings& settings = joint.settings();
  FitSettings alone = settings;
  alone.shared.fill(false);
  std::vector<size_t> shared;
  for (size_t j = 0; j < joint.size(); ++j)
    if (joint.free()[j].condition < 0) shared.push_back(j);
  std::vector<std::vector<double>> proposals;
  std::vector<double> mean(shared.size(), 0.0);
  size_t used = 0;
  for (const Condition& condition : conditions) {
    const Objective objective({condition}, alone);
    if (objective.spread(0).range() <= 0.0) continue;  // one level: the others tell
    const Optimum optimum = best(objective, startsOf(objective, kStarts));
    if (!std::isfinite(optimum.value)) continue;
    std::vector<double> proposal;
    for (const size_t j : shared) {
      const int place = objective.place(0, joint.free()[j].parameter);
      proposal.push_back(
          std::clamp(optimum.x[static_cast<size_t>(place)], joint.free()[j].low, joint.free()[j].high));
    }
    for (size_t i = 0; i < shared.size(); ++i) mean[i] += proposal[i];
    ++used;
    proposals.push_back(std::move(proposal));
  }
  if (used > 0) {
    for (double& value : mean) value /= static_cast<double>(used);
    proposals.insert(proposals.begin(), mean);
  } else {
    for (size_t i = 0; i < shared.size(); ++i)
      mean[i] = 0.5 * (joint.free()[shared[i]].low + joint.free()[shared[i]].high);
    proposals.push_back(mean);
  }
  if (proposals.size() > kMost) proposals.resize(kMost);
  std::vector<std::vector<double>> starts;
  for (const std::vector<double>& proposal : proposals) {
    FitSettings held = alone;
    std::vector<double> x(joint.size());
    for (size_t i = 0; i < shared.size(); ++i) {
      const FitParameter parameter = joint.free()[shared[i]].parameter;
      x[shared[i]] = proposal[i];
      held.fixed[indexOf(parameter)] = parameter == FitParameter::Width ? std::exp(proposal[i])
                                       : parameter == FitParameter::Threshold
                                           ? joint.shape().offAxis(proposal[i])
                                           : proposal[i];
    }
    for (size_t c = 0; c < conditions.size(); ++c) {
      const Objective objective({conditions[c]}, held);
      const Optimum optimum = best(objective, startsOf(objective, 2));
      if (optimum.x.empty()) continue;
      for (const auto& [from, to] : commonPlaces(objective, 0, joint, c))
        x[to] = std::clamp(optimum.x[from], joint.free()[to].low, joint.free()[to].high);
    }
    starts.push_back(std::move(x));
  }
  return starts;
}

ConditionFit describe(const Condition& condition, const Objective& objective, size_t c,
                      const Optimum& optimum) {
  const SigmoidShape& shape = objective.shape();
  const PreparedBlocks& blocks = objective.blocks(c);
  const AxisValues values = objective.valuesOf(c, optimum.x.data());
  ConditionFit fit;
  fit.name = condition.name;
  fit.values = values;
  fit.values[indexOf(FitParameter::Threshold)] = shape.offAxis(values[indexOf(FitParameter::Threshold)]);
  for (size_t i = 0; i < kFitParameters; ++i) {
    const int place = objective.place(c, static_cast<FitParameter>(i));
    fit.fitted[i] = place >= 0;
    if (place >= 0) fit.atBound[i] = optimum.atBound[static_cast<size_t>(place)];
  }
  if (shape.falling) fit.atBound[indexOf(FitParameter::Threshold)] *= -1;
  if (objective.settings().task.kind == FitTask::Kind::EqualAsymptotes) {
    fit.fitted[indexOf(FitParameter::Guess)] = fit.fitted[indexOf(FitParameter::Lapse)];
    fit.atBound[indexOf(FitParameter::Guess)] = fit.atBound[indexOf(FitParameter::Lapse)];
  }
  const FitSettings& settings = objective.settings();
  const double mirrored = fit.sigmoid(settings).threshold(shape.level);
  fit.slope = fit.sigmoid(settings).derivative(mirrored);
  // F(-x) or F(1/x): the inner derivative is -1, or -1/x^2.
  if (shape.falling) fit.slope *= shape.logarithmic ? -mirrored * mirrored : -1.0;
  fit.logLikelihood = blocks.logSaturated - negativeLogLikelihood(shape, blocks, values, nullptr);
  for (size_t i = 0; i < blocks.u.size(); ++i) {
    fit.deviance +=
        2.0 * halfBlockDeviance(chanceAt(shape, blocks.u[i], values), blocks.correct[i], blocks.trials[i]);
    fit.trials += blocks.trials[i];
  }
  fit.blocks = blocks.u.size();
  if (objective.settings().method == FitMethod::MaximumPosterior) {
    for (size_t i = 0; i < kFitParameters; ++i) {
      const FitParameter parameter = static_cast<FitParameter>(i);
      if (const int place = objective.place(c, parameter); place >= 0)
        fit.logPrior +=
            logPrior(parameter, values[i], objective.free()[static_cast<size_t>(place)].spread).value;
    }
  }
  return fit;
}

/// The stimulus that F rises with.
double risingStimulus(const FitSettings& settings, double x) {
  if (!settings.falling) return x;
  return settings.logarithmic() ? 1.0 / x : -x;
}

/// What the reader has to know about a condition's numbers.
void warn(const Condition& condition, const Objective& objective, size_t c, ConditionFit& fit) {
  std::vector<std::string>& warnings = fit.warnings;
  const PreparedBlocks& blocks = objective.blocks(c);
  int64_t correct = 0, trials = 0;
  for (size_t i = 0; i < blocks.u.size(); ++i) {
    correct += blocks.correct[i];
    trials += blocks.trials[i];
  }
  if (blocks.u.size() < condition.blocks.size())
    warnings.push_back(
        fmt::format("{} block(s) without trials left out", condition.blocks.size() - blocks.u.size()));
  if (correct == trials) warnings.push_back("every answer is correct");
  if (correct == 0) warnings.push_back("no answer is correct");
  const bool falling = objective.shape().falling;
  if (covariance(blocks) < 0.0)
    warnings.push_back(falling ? "answers get better with the level, but a falling function is fitted"
                               : "answers get worse with the level, but a rising function is fitted");
  const auto at = [&](FitParameter parameter) { return fit.atBound[indexOf(parameter)]; };
  if (at(FitParameter::Threshold) != 0)
    warnings.push_back(fmt::format("the threshold is at the {} bound of the fit; the data do not tell it",
                                   at(FitParameter::Threshold) < 0 ? "lower" : "upper"));
  if (at(FitParameter::Width) < 0)
    warnings.push_back(
        "the width is at its lower bound: the answers change within one step of the levels, "
        "and tell neither how steeply nor where in between");
  if (at(FitParameter::Width) > 0)
    warnings.push_back("the width is at its upper bound: the levels are too close together to tell it");
  if (at(FitParameter::Lapse) > 0)
    warnings.push_back(
        fmt::format("the lapse rate is at its upper bound of {}", objective.settings().lapseMost));
  if (objective.settings().task.kind == FitTask::Kind::YesNo && at(FitParameter::Guess) > 0)
    warnings.push_back(
        fmt::format("the guess rate is at its upper bound of {}", objective.settings().guessMost));
  std::vector<double> levels = blocks.u;
  std::sort(levels.begin(), levels.end());
  levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
  size_t own = 0;
  for (size_t i = 0; i < kFitParameters; ++i)
    if (objective.place(c, static_cast<FitParameter>(i)) >= 0 && !objective.settings().shared[i]) ++own;
  if (own > levels.size())
    warnings.push_back(fmt::format("{} parameters are fitted to {} level(s)", own, levels.size()));
}

}  // namespace

psychometrics::Sigmoid ConditionFit::sigmoid(const FitSettings& settings) const {
  return psychometrics::Sigmoid::fromThresholdWidth(settings.sigmoid, settings.axis,
                                                    risingStimulus(settings, value(FitParameter::Threshold)),
                                                    value(FitParameter::Width), settings.thresholdLevel);
}

double ConditionFit::probability(const FitSettings& settings, double x) const {
  const double guess = value(FitParameter::Guess), lapse = value(FitParameter::Lapse);
  if (x == kNoStimulus) return guess;
  return guess + (1.0 - guess - lapse) * sigmoid(settings).value(risingStimulus(settings, x));
}

Fit fitPsychometric(const std::vector<Condition>& conditions, const FitSettings& settings,
                    const std::string& where) {
  checkFit(conditions, settings, where);
  const Objective objective(conditions, settings);
  Optimum optimum;
  if (conditions.size() > 1 && settings.sharesAny()) {
    optimum = best(objective, startsOfDesign(conditions, objective));
  } else {
    // Conditions that share nothing: one after the other.
    optimum.x.resize(objective.size());
    optimum.atBound.resize(objective.size());
    for (size_t c = 0; c < conditions.size(); ++c) {
      const Optimum one = optimumOfOne(conditions[c], settings);
      optimum.value = one.value;
      if (!std::isfinite(one.value)) break;
      if (one.x.empty()) continue;
      for (const auto& [from, to] : commonPlaces(Objective({conditions[c]}, settings), 0, objective, c)) {
        optimum.x[to] = one.x[from];
        optimum.atBound[to] = one.atBound[from];
      }
    }
    if (std::isfinite(optimum.value)) optimum.value = objective.evaluate(optimum.x.data(), nullptr);
  }
  if (!std::isfinite(optimum.value) || optimum.x.size() != objective.size())
    throw Error("no parameters within the bounds make these answers possible", where,
                "leave guess and lapse rate free, or above 0");
  Fit fit;
  fit.settings = settings;
  fit.x = optimum.x;
  fit.freeParameters = objective.size();
  int64_t trials = 0;
  for (size_t c = 0; c < conditions.size(); ++c) {
    fit.conditions.push_back(describe(conditions[c], objective, c, optimum));
    fit.deviance += fit.conditions.back().deviance;
    fit.logLikelihood += fit.conditions.back().logLikelihood;
    trials += fit.conditions.back().trials;
    warn(conditions[c], objective, c, fit.conditions.back());
  }
  if (settings.method == FitMethod::MaximumPosterior) fit.logPrior = objective.logPriorAt(fit.x.data());
  const double k = static_cast<double>(fit.freeParameters);
  fit.aic = 2.0 * k - 2.0 * fit.logLikelihood;
  fit.bic = k * std::log(static_cast<double>(trials)) - 2.0 * fit.logLikelihood;
  return fit;
}

LikelihoodRatio likelihoodRatio(const Fit& restricted, const Fit& full) {
  assert(full.freeParameters > restricted.freeParameters);
  LikelihoodRatio ratio;
  // Rounding can leave equal fits a hair apart.
  ratio.statistic = std::max(0.0, 2.0 * (full.logLikelihood - restricted.logLikelihood));
  ratio.degrees = full.freeParameters - restricted.freeParameters;
  ratio.p = chiSquaredUpper(ratio.statistic, static_cast<double>(ratio.degrees));
  return ratio;
}

}  // namespace limen::analysis
