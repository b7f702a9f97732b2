// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/fits/fit_answer.h"
#include "analysis/output/text_output.h"
#include "analysis/psychometric/coverage.h"
#include "analysis/psychometric/objective.h"
#include "experiments/base/build_facts.h"
#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

std::string heading(const FitAnswer& answer) {
  const FitSettings& settings = answer.fit.settings;
  std::string out = fmt::format(
      "psychometric function of {}, {}: P = guess + (1 - guess - lapse) F\nF {}, {} on a {} axis, task {}, "
      "{}; "
      "threshold "
      "at F = {}, width from F = 0.05 to 0.95{}\n",
      answer.level, answer.part.empty() ? answer.file : "part " + answer.part,
      psychometrics::nameOf(settings.sigmoid), settings.falling ? "falling" : "rising",
      settings.logarithmic() ? "logarithmic" : "linear", nameOf(settings.task),
      settings.method == FitMethod::MaximumLikelihood ? "maximum likelihood" : "maximum a posteriori",
      shortestNumber(settings.thresholdLevel), settings.logarithmic() ? " in units of ln x" : "");
  std::vector<std::string> held, shared;
  for (size_t i = 0; i < kFitParameters; ++i) {
    if (settings.fixed[i])
      held.push_back(fitParameterNames()[i] + " = " + shortestNumber(*settings.fixed[i]));
    if (settings.shared[i]) shared.push_back(fitParameterNames()[i]);
  }
  if (!held.empty()) out += "fixed: " + join(held) + "\n";
  if (!shared.empty()) out += "shared by all conditions: " + join(shared) + "\n";
  for (const std::string& note : answer.notes) out += "note: " + note + "\n";
  return out + "limen-analyse " + projectVersion() + ", commit " + buildCommit() + "\n";
}

std::string rangeText(const FitInterval& interval) {
  return fmt::format("{:.7g}{} to {:.7g}{}", interval.low, interval.lowOpen ? " (bound)" : "", interval.high,
                     interval.highOpen ? " (bound)" : "");
}

std::string parameterLines(const FitAnswer& answer, size_t c) {
  const ConditionFit& fit = answer.fit.conditions[c];
  const FitQuantities quantities = quantitiesOf(fit);
  std::string out;
  for (size_t i = 0; i < kFitQuantities; ++i) {
    const bool parameter = i < kFitParameters;
    if (i == indexOf(FitParameter::Eta) && !fit.fitted[i] && quantities[i] == 0.0) continue;
    const int bound = parameter ? fit.atBound[i] : 0;
    std::string note;
    if (answer.intervals)
      if (const auto& interval = answer.intervals->conditions[c][i]) note = rangeText(*interval);
    if (parameter && !fit.fitted[i]) note = "not fitted";
    if (bound != 0)
      note += std::string(note.empty() ? "" : "  ") + (bound < 0 ? "(at lower bound)" : "(at upper bound)");
    out += fmt::format("    {:<11}{:>16.8g}  {}\n", quantityName(i), quantities[i], note);
  }
  return out;
}

std::string testLine(const char* name, const MonteCarloTest& test, bool upperOnly) {
  const std::string limits = upperOnly ? fmt::format("up to {:.4g}", test.high)
                                       : fmt::format("{:.3g} to {:.3g}", test.low, test.high);
  return fmt::format("    {:<34}{:>10.4g}  95 % of samples {}  p = {:.3g}\n", name, test.value, limits,
                     test.p);
}

std::string goodnessLines(const FitAnswer& answer, size_t c) {
  if (answer.goodness.empty()) return {};
  const Goodness& goodness = answer.goodness[c];
  std::string out = "  goodness of fit (" + std::to_string(answer.samples) + " samples)\n" +
                    testLine("deviance", goodness.deviance, true) +
                    testLine("residuals with prediction", goodness.withPrediction, false) +
                    testLine("residuals with order", goodness.withOrder, false) +
                    fmt::format("    {:>12}{:>12}{:>12}{:>14}{:>14}\n", "level", "predicted", "residual",
                                "threshold", "width");
  for (size_t i = 0; i < goodness.influences.size(); ++i) {
    const BlockInfluence& without = goodness.influences[i];
    const double level = goodness.residuals.levels[i];
    out += fmt::format("    {:>12}{:>12.4f}{:>12.3f}",
                       std::isfinite(level) ? fmt::format("{:.6g}", level) : "none",
                       goodness.residuals.predicted[i], goodness.residuals.values[i]);
    out += without.refused ? fmt::format("{:>28}", "no fit without it")
                           : fmt::format("{:>14.6g}{:>14.6g}", without.threshold, without.width);
    out += without.influential ? "  influential\n" : "\n";
  }
  return out + "    threshold and width: those of a fit without the block\n";
}

std::string priorLines(const FitAnswer& answer, size_t c) {
  const bool posterior = answer.intervals && answer.intervals->method == IntervalMethod::Posterior;
  if (answer.fit.settings.method != FitMethod::MaximumPosterior && !posterior) return {};
  std::string out = "  priors\n";
  const Objective objective(answer.data, answer.fit.settings);
  for (size_t i = 0; i < kFitParameters; ++i) {
    const FitParameter parameter = static_cast<FitParameter>(i);
    const int place = objective.place(c, parameter);
    if (place < 0) continue;
    const FreeParameter& free = objective.free()[static_cast<size_t>(place)];
    const bool rate = parameter != FitParameter::Threshold && parameter != FitParameter::Width;
    out += fmt::format("    {:<11}{}{}\n", fitParameterNames()[i],
                       priorText(parameter, free.spread, answer.fit.settings.falling),
                       rate ? " up to " + shortestNumber(free.high) : "");
  }
  return out;
}

}  // namespace

const std::string& quantityName(size_t quantity) {
  static const std::string kSlope = "slope";
  return quantity < kFitParameters ? fitParameterNames()[quantity] : kSlope;
}

std::string toText(const FitAnswer& answer) {
  std::string out = heading(answer);
  if (answer.intervals) {
    const FitIntervals& intervals = *answer.intervals;
    out += fmt::format("{} % intervals: {}", shortestNumber(100.0 * intervals.confidence),
                       nameOf(intervals.method));
    if (intervals.method == IntervalMethod::Bootstrap || intervals.method == IntervalMethod::Bca)
      out += fmt::format(", {}, {} samples, seed {}", answer.parametric ? "parametric" : "nonparametric",
                         answer.samples, answer.seed);
    out += "\n";
    for (const std::string& note :
         coverageNotes(intervals.method, answer.parametric, answer.fit.settings.task))
      out += "  note: " + note + "\n";
    for (const std::string& warning : intervals.warnings) out += "  warning: " + warning + "\n";
  }
  for (size_t c = 0; c < answer.fit.conditions.size(); ++c) {
    const ConditionFit& fit = answer.fit.conditions[c];
    out += fmt::format("\n{}{} trials at {} levels or blocks\n", fit.name.empty() ? "" : fit.name + ": ",
                       fit.trials, fit.blocks);
    out += parameterLines(answer, c);
    out += fmt::format("    {:<11}{:>16.8g}\n    {:<11}{:>16.8g}\n", "deviance", fit.deviance, "log lik.",
                       fit.logLikelihood);
    out += goodnessLines(answer, c) + priorLines(answer, c);
    for (const std::string& warning : fit.warnings) out += "  warning: " + warning + "\n";
  }
  out += fmt::format("\n{:<12}{:>12}{:>18}{:>14}{:>14}\n", "", "parameters", "log likelihood", "AIC", "BIC");
  const auto line = [&](const char* name, const Fit& fit) {
    out += fmt::format("{:<12}{:>12}{:>18.7g}{:>14.7g}{:>14.7g}\n", name, fit.freeParameters,
                       fit.logLikelihood, fit.aic, fit.bic);
  };
  line(answer.full ? "shared" : "all", answer.fit);
  if (answer.full) line("not shared", *answer.full);
  if (answer.ratio)
    out += fmt::format(
        "likelihood ratio: chi-squared {:.6g} with {} degrees of freedom, p = {:.4g} (approximate; rates "
        "at a bound make p too large)\n",
        answer.ratio->statistic, answer.ratio->degrees, answer.ratio->p);
  return out;
}

namespace {

const std::vector<std::string> kColumns = {"condition",       "parameter",      "estimate", "low",     "high",
                                           "interval_method", "interval_level", "fitted",   "at_bound"};

std::vector<std::vector<std::string>> rowsOf(const FitAnswer& answer) {
  const auto number = [](double value) {
    return std::isfinite(value) ? shortestNumber(value) : std::string();
  };
  std::vector<std::vector<std::string>> out;
  for (size_t c = 0; c < answer.fit.conditions.size(); ++c) {
    const ConditionFit& fit = answer.fit.conditions[c];
    const FitQuantities quantities = quantitiesOf(fit);
    for (size_t i = 0; i < kFitQuantities; ++i) {
      std::string low, high, method, level;
      if (answer.intervals) {
        if (const auto& interval = answer.intervals->conditions[c][i]) {
          low = number(interval->low);
          high = number(interval->high);
          method = nameOf(answer.intervals->method);
          level = number(answer.intervals->confidence);
        }
      }
      const bool parameter = i < kFitParameters;
      const int bound = parameter ? fit.atBound[i] : 0;
      out.push_back({fit.name, quantityName(i), number(quantities[i]), low, high, method, level,
                     parameter ? (fit.fitted[i] ? "1" : "0") : "",
                     bound < 0   ? "low"
                     : bound > 0 ? "high"
                                 : ""});
    }
    out.push_back({fit.name, "deviance", number(fit.deviance), "", "", "", "", "", ""});
    out.push_back({fit.name, "log_likelihood", number(fit.logLikelihood), "", "", "", "", "", ""});
  }
  return out;
}

}  // namespace

std::string toCsv(const FitAnswer& answer) {
  std::string out = csvLine(kColumns);
  for (const std::vector<std::string>& row : rowsOf(answer)) out += csvLine(row);
  return out;
}

std::string toCsv(const std::vector<FitAnswer>& parts) {
  std::vector<std::string> heading = kColumns;
  heading.insert(heading.begin(), "part");
  std::string out = csvLine(heading);
  for (const FitAnswer& part : parts)
    for (std::vector<std::string> row : rowsOf(part)) {
      row.insert(row.begin(), part.part);
      out += csvLine(row);
    }
  return out;
}

}  // namespace limen::analysis
