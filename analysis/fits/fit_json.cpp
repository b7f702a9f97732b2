// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/fits/fit_answer.h"
#include "analysis/psychometric/coverage.h"
#include "analysis/psychometric/objective.h"
#include "experiments/base/build_facts.h"

namespace limen::analysis {
namespace {

using nlohmann::json;

json settingsOf(const FitAnswer& answer, size_t c) {
  const FitSettings& settings = answer.fit.settings;
  json out = {{"task", nameOf(settings.task)},
              {"sigmoid", psychometrics::nameOf(settings.sigmoid)},
              {"axis", settings.logarithmic() ? "log" : "linear"},
              {"direction", settings.falling ? "falling" : "rising"},
              {"method", settings.method == FitMethod::MaximumLikelihood ? "ml" : "map"},
              {"threshold_level", settings.thresholdLevel},
              {"width_from", 0.05},
              {"width_to", 0.95},
              {"overdispersion", settings.overdispersion},
              {"fixed", json::object()},
              {"shared", json::array()},
              {"bounds", json::object()}};
  const Objective objective(answer.data, settings);
  for (size_t i = 0; i < kFitParameters; ++i) {
    const std::string& name = fitParameterNames()[i];
    if (settings.fixed[i]) out["fixed"][name] = *settings.fixed[i];
    if (settings.shared[i]) out["shared"].push_back(name);
    const int place = objective.place(c, static_cast<FitParameter>(i));
    if (place < 0) continue;
    const FreeParameter& free = objective.free()[static_cast<size_t>(place)];
    out["bounds"][name] =
        free.parameter == FitParameter::Width       ? std::array{std::exp(free.low), std::exp(free.high)}
        : free.parameter == FitParameter::Threshold ? objective.shape().offAxis(free.low, free.high)
                                                    : std::array{free.low, free.high};
    if (settings.method == FitMethod::MaximumPosterior ||
        (answer.intervals && answer.intervals->method == IntervalMethod::Posterior))
      out["priors"][name] = priorText(free.parameter, free.spread, settings.falling);
  }
  return out;
}

json testOf(const MonteCarloTest& test, bool upperOnly) {
  json out = {{"value", test.value}, {"limit_high", test.high}, {"p", test.p}};
  if (!upperOnly) out["limit_low"] = test.low;
  return out;
}

json goodnessOf(const FitAnswer& answer, size_t c) {
  const Goodness& goodness = answer.goodness[c];
  json blocks = json::array();
  for (size_t i = 0; i < goodness.residuals.values.size(); ++i) {
    const double level = goodness.residuals.levels[i];
    json block = {{"level", std::isfinite(level) ? json(level) : json()},
                  {"no_stimulus", !std::isfinite(level)},
                  {"predicted", goodness.residuals.predicted[i]},
                  {"deviance_residual", goodness.residuals.values[i]}};
    const BlockInfluence& influence = goodness.influences[i];
    block["influential"] = influence.influential;
    block["threshold_without"] = influence.refused ? json() : json(influence.threshold);
    block["width_without"] = influence.refused ? json() : json(influence.width);
    blocks.push_back(std::move(block));
  }
  return {{"deviance", testOf(goodness.deviance, true)},
          {"residuals_prediction", testOf(goodness.withPrediction, false)},
          {"residuals_order", testOf(goodness.withOrder, false)},
          {"blocks", blocks},
          {"samples", answer.samples},
          {"seed", answer.seed}};
}

json intervalsOf(const FitAnswer& answer, size_t c) {
  const FitIntervals& intervals = *answer.intervals;
  json out = {{"method", nameOf(intervals.method)}, {"level", intervals.confidence}, {"open", json::array()}};
  if (intervals.method == IntervalMethod::Bootstrap || intervals.method == IntervalMethod::Bca) {
    out["resampling"] = answer.parametric ? "parametric" : "nonparametric";
    out["samples"] = answer.samples;
    out["seed"] = answer.seed;
  }
  for (size_t i = 0; i < kFitQuantities; ++i) {
    const auto& interval = intervals.conditions[c][i];
    const std::string& name = quantityName(i);
    out[name] = interval ? json{interval->low, interval->high} : json();
    if (interval && interval->lowOpen) out["open"].push_back(name + " low");
    if (interval && interval->highOpen) out["open"].push_back(name + " high");
  }
  out["notes"] = coverageNotes(intervals.method, answer.parametric, answer.fit.settings.task);
  return out;
}

json conditionOf(const FitAnswer& answer, size_t c) {
  const ConditionFit& fit = answer.fit.conditions[c];
  json out = {{"name", fit.name},
              {"trials", fit.trials},
              {"blocks", fit.blocks},
              {"slope", fit.slope},
              {"slope_meaning", "dF/dx at the threshold"},
              {"deviance", fit.deviance},
              {"log_likelihood", fit.logLikelihood},
              {"at_bound", json::array()},
              {"fitted", json::array()},
              {"settings", settingsOf(answer, c)},
              {"warnings", fit.warnings}};
  for (size_t i = 0; i < kFitParameters; ++i) {
    out[fitParameterNames()[i]] = fit.values[i];
    if (fit.fitted[i]) out["fitted"].push_back(fitParameterNames()[i]);
    if (fit.atBound[i] != 0)
      out["at_bound"].push_back(fitParameterNames()[i] + (fit.atBound[i] < 0 ? " low" : " high"));
  }
  const psychometrics::Sigmoid sigmoid = fit.sigmoid(answer.fit.settings);
  const bool falling = answer.fit.settings.falling, logarithmic = answer.fit.settings.logarithmic();
  // Of x, where the sigmoid is one of -x or 1/x.
  out["location"] = falling ? -sigmoid.location() : sigmoid.location();
  out["scale"] = sigmoid.scale();
  out["alpha"] = !falling      ? sigmoid.alpha()
                 : logarithmic ? std::exp(-sigmoid.location())
                               : -sigmoid.location();
  out["beta"] = sigmoid.beta();
  // Priors of a parameter that conditions share have no condition of their own.
  const bool map = answer.fit.settings.method == FitMethod::MaximumPosterior;
  out["log_posterior"] = map ? json(fit.logLikelihood + fit.logPrior) : json();
  out["intervals"] = answer.intervals ? intervalsOf(answer, c) : json();
  out["goodness"] = answer.goodness.empty() ? json() : goodnessOf(answer, c);
  return out;
}

json summaryOf(const Fit& fit) {
  return {{"parameters", fit.freeParameters},
          {"log_likelihood", fit.logLikelihood},
          {"deviance", fit.deviance},
          {"aic", fit.aic},
          {"bic", fit.bic}};
}

}  // namespace

json toJson(const FitAnswer& answer) {
  json versions = {{"limen", projectVersion()}, {"commit", buildCommit()}};
  for (const auto& [name, version] : fitLibraries()) versions[name] = version;
  json out = {{"command", "fit"},
              {"file", answer.file},
              {"sha256", answer.hash},
              {"x", answer.level},
              {"notes", answer.notes},
              {"versions", versions},
              {"all", summaryOf(answer.fit)},
              {"conditions", json::array()},
              {"warnings", answer.intervals ? json(answer.intervals->warnings) : json::array()}};
  if (answer.fit.settings.method == FitMethod::MaximumPosterior)
    out["all"]["log_posterior"] = answer.fit.logPosterior();
  for (size_t c = 0; c < answer.data.size(); ++c) out["conditions"].push_back(conditionOf(answer, c));
  if (answer.full) out["unshared"] = summaryOf(*answer.full);
  if (answer.ratio)
    out["likelihood_ratio"] = {{"statistic", answer.ratio->statistic},
                               {"degrees", answer.ratio->degrees},
                               {"p", answer.ratio->p},
                               {"note", "chi-squared; approximate for few trials and for rates at a bound"}};
  if (!answer.part.empty()) out["part"] = answer.part;
  return out;
}

}  // namespace limen::analysis
