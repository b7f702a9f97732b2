// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/groups/mixed.h"
#include "analysis/output/text_output.h"
#include "analysis/output/text_table.h"
#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

using nlohmann::json;
using Rows = std::vector<std::vector<std::string>>;

constexpr const char* kMethod =
    "maximum likelihood by Laplace's approximation; z tests and 95 % intervals after Wald";

/// e to the estimate; none where that is beyond what a number holds.
std::optional<double> oddsRatio(double logOdds) {
  const double ratio = std::exp(logOdds);
  return std::isfinite(ratio) ? std::optional(ratio) : std::nullopt;
}

std::string numberText(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? fmt::format("{:.4g}", *value) : "-";
}

/// What the optimiser leaves of an estimate of 0 is far below its error.
double withoutNoise(double value, double error) { return std::abs(value) < 1e-8 * error ? 0.0 : value; }

std::string rangeText(const std::optional<double>& low, const std::optional<double>& high) {
  return numberText(low) + " to " + numberText(high);
}

std::string codingLine(const ModelColumn& column) {
  if (!column.numeric)
    return fmt::format("{}: {} against {}\n", column.name,
                       join({column.levels.begin() + 1, column.levels.end()}), column.levels[0]);
  std::string out = column.name + ": numbers";
  if (column.logarithmic) out += ", natural logarithm";
  if (column.centred)
    out += fmt::format(", minus {:.6g} (mean{} over rows)", column.centre,
                       column.logarithmic ? " of logarithms" : "");
  return out + "\n";
}

std::string randomLines(const MixedModel& model) {
  Rows table = {{"random effect of " + model.group, "sd"},
                {"intercept", numberText(model.fit.interceptDeviation)}};
  if (!model.slope.empty()) {
    table[0].push_back("correlation");
    table[1].push_back("");
    table.push_back({model.slope, numberText(model.fit.slopeDeviation), fixedText(model.fit.correlation)});
  }
  return alignedText(table, {0});
}

}  // namespace

std::string toText(const MixedModel& model) {
  std::string out = fmt::format(
      "\nmixed-effects logistic regression, {}\n  {} rows, {} answers, {} of them 1 ({}), {} groups of "
      "'{}'\n",
      model.measure, model.rows, model.trials, model.successes,
      percentText(static_cast<double>(model.successes) / static_cast<double>(model.trials)),
      model.groups.size(), model.group);
  for (const ModelColumn& column : model.columns) out += "  " + codingLine(column);
  Rows table = {{"fixed effect", "estimate", "error", "z", "p", "95 %", "odds ratio", "95 %"}};
  for (const FixedEffect& effect : model.fit.fixed)
    table.push_back({effect.name, numberText(withoutNoise(effect.estimate, effect.standardError)),
                     numberText(effect.standardError), fixedText(withoutNoise(effect.z, 1.0)),
                     pText(effect.p), rangeText(effect.interval.low, effect.interval.high),
                     numberText(oddsRatio(effect.estimate)),
                     rangeText(oddsRatio(effect.interval.low), oddsRatio(effect.interval.high))});
  out += "\n" + alignedText(table, {0}) + "\n" + randomLines(model) + "\n";
  out += fmt::format("  log likelihood {:.6g}, AIC {:.6g}\n", model.fit.logLikelihood, model.fit.aic);
  if (!model.fit.note.empty()) out += "  note: " + model.fit.note + "\n";
  return out + "  ln(p / (1 - p)) = fixed effects + what each " + model.group + " adds to the intercept" +
         (model.slope.empty() ? "" : " and to the slope") + "\n  " + kMethod + "\n";
}

json toJson(const MixedModel& model) {
  json columns = json::array(), fixed = json::array(), groups = json::array();
  for (const ModelColumn& column : model.columns) {
    json one = {{"name", column.name}, {"numeric", column.numeric}};
    if (column.numeric) {
      one["logarithm"] = column.logarithmic;
      one["centre"] = column.centred ? json(column.centre) : json();
    } else {
      one["levels"] = column.levels;
      one["reference"] = column.levels[0];
    }
    columns.push_back(one);
  }
  for (const FixedEffect& effect : model.fit.fixed)
    fixed.push_back({{"name", effect.name},
                     {"estimate", numberJson(effect.estimate)},
                     {"standard_error", numberJson(effect.standardError)},
                     {"z", numberJson(effect.z)},
                     {"p", numberJson(effect.p)},
                     {"interval", intervalJson(effect.interval)},
                     {"odds_ratio", numberJson(oddsRatio(effect.estimate))},
                     {"odds_ratio_interval", json::array({numberJson(oddsRatio(effect.interval.low)),
                                                          numberJson(oddsRatio(effect.interval.high))})}});
  for (const GroupEffect& effect : model.fit.groups) {
    json one = {{"group", model.groups[effect.group]}, {"intercept", numberJson(effect.intercept)}};
    if (!model.slope.empty()) one["slope"] = numberJson(effect.slope);
    groups.push_back(one);
  }
  return {{"measure", model.measure},
          {"group", model.group},
          {"rows", model.rows},
          {"successes", model.successes},
          {"trials", model.trials},
          {"columns", columns},
          {"fixed", fixed},
          {"random",
           {{"intercept_sd", model.fit.interceptDeviation},
            {"slope", model.slope.empty() ? json() : json(model.slope)},
            {"slope_sd", numberJson(model.fit.slopeDeviation)},
            {"correlation", numberJson(model.fit.correlation)}}},
          {"groups", groups},
          {"log_likelihood", model.fit.logLikelihood},
          {"aic", model.fit.aic},
          {"singular", model.fit.singular},
          {"note", model.fit.note},
          {"method", kMethod}};
}

std::string toCsv(const MixedModel& model) {
  std::string out = csvLine({"kind", "name", "estimate", "standard_error", "z", "p", "low", "high",
                             "odds_ratio", "odds_ratio_low", "odds_ratio_high"});
  for (const FixedEffect& effect : model.fit.fixed)
    out += csvLine({"fixed", effect.name, cellText(effect.estimate), cellText(effect.standardError),
                    cellText(effect.z), cellText(effect.p), cellText(effect.interval.low),
                    cellText(effect.interval.high), cellText(oddsRatio(effect.estimate)),
                    cellText(oddsRatio(effect.interval.low)), cellText(oddsRatio(effect.interval.high))});
  const auto random = [&](const std::string& name, const std::optional<double>& value) {
    if (value) out += csvLine({"random", name, cellText(value), "", "", "", "", "", "", "", ""});
  };
  random("intercept_sd", model.fit.interceptDeviation);
  random("slope_sd", model.fit.slopeDeviation);
  random("correlation", model.fit.correlation);
  return out;
}

}  // namespace limen::analysis
