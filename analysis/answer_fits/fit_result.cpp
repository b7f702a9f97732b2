// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>

#include "analysis/answer_fits/fit_answer.h"
#include "analysis/psychometric/intervals.h"
#include "analysis/psychometric/objective.h"
#include "experiments/base/build_facts.h"
#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

/// A parameter, or the slope, of one condition as fitted.
struct ParameterRow {
  size_t index = 0;  ///< of the condition
  std::string condition, name;
  double value = 0.0;
  std::optional<FitInterval> interval;
  std::optional<bool> fitted, shared;
  int bound = 0;
  std::optional<Interval> bounds;  ///< that the fit kept to
  std::string prior;
};

/// Of x, or of what was varied.
std::optional<Interval> boundsOf(const Objective& objective, const FreeParameter& free) {
  if (free.parameter == FitParameter::Width) return Interval{std::exp(free.low), std::exp(free.high)};
  if (free.parameter != FitParameter::Threshold) return Interval{free.low, free.high};
  const std::array<double, 2> levels = objective.shape().offAxis(free.low, free.high);
  return Interval{levels[0], levels[1]};
}

std::vector<ParameterRow> parameterRows(const FitAnswer& answer) {
  const FitSettings& settings = answer.fit.settings;
  const Objective objective(answer.data, settings);
  const bool priors = settings.method == FitMethod::MaximumPosterior ||
                      (answer.intervals && answer.intervals->method == IntervalMethod::Posterior);
  std::vector<ParameterRow> out;
  for (size_t c = 0; c < answer.fit.conditions.size(); ++c) {
    const ConditionFit& fit = answer.fit.conditions[c];
    const FitQuantities quantities = quantitiesOf(fit);
    for (size_t i = 0; i < kFitQuantities; ++i) {
      ParameterRow row;
      row.index = c;
      row.condition = fit.name;
      row.name = quantityName(i);
      row.value = quantities[i];
      if (answer.intervals) row.interval = answer.intervals->conditions[c][i];
      if (i < kFitParameters) {
        row.fitted = fit.fitted[i];
        row.shared = settings.shared[i];
        row.bound = fit.atBound[i];
        if (const int place = objective.place(c, static_cast<FitParameter>(i)); place >= 0) {
          const FreeParameter& free = objective.free()[static_cast<size_t>(place)];
          row.bounds = boundsOf(objective, free);
          if (priors) row.prior = priorText(free.parameter, free.spread, settings.falling);
        }
      }
      out.push_back(std::move(row));
    }
  }
  return out;
}

/// A column for each factor of a study's conditions; `indexOfRow` says which condition a row is of.
template <class Table, class Index>
void addLevels(const FitAnswer& answer, Table& out, Index indexOfRow) {
  if (answer.levels.size() != answer.fit.conditions.size() || answer.levels.empty()) return;
  for (const auto& [factor, first] : answer.levels.front())
    out.add(forData(text(factor)), [&, name = factor](const auto& row) {
      const auto& levels = answer.levels[indexOfRow(row)];
      const auto own = levels.find(name);
      return own == levels.end() ? ResultCell() : ResultCell(own->second);
    });
}

ResultTable parameterTable(const FitAnswer& answer) {
  const std::vector<ParameterRow> rows = parameterRows(answer);
  Column bounds =
      interval("", answer.intervals ? fmt::format("{:.4g} %", 100.0 * answer.intervals->confidence) : "95 %");
  bounds.kind = Kind::Significant;
  bounds.digits = 4;
  TableOf out("parameters", "", rows);
  out.add(ifAny(text("condition")), &ParameterRow::condition);
  addLevels(answer, out, [](const ParameterRow& row) { return row.index; });
  return out.add(text("parameter"), &ParameterRow::name)
      .add(significant("estimate"), &ParameterRow::value)
      .add(ifAny(bounds), &ParameterRow::interval)
      .add(ifAny(flag("low_open", "low at bound")), at(&ParameterRow::interval, &FitInterval::lowOpen))
      .add(ifAny(flag("high_open", "high at bound")), at(&ParameterRow::interval, &FitInterval::highOpen))
      .add(flag("fitted"), &ParameterRow::fitted)
      .add(ifAny(text("at_bound")),
           [](const ParameterRow& row) { return row.bound < 0   ? "low"
                                                : row.bound > 0 ? "high"
                                                                : ""; })
      .add(forData(text("interval_method")),
           [&](const ParameterRow& row) {
             return row.interval ? ResultCell(toText(answer.intervals->method)) : ResultCell();
           })
      .add(forData(number("level")),
           [&](const ParameterRow& row) {
             return row.interval ? ResultCell(answer.intervals->confidence) : ResultCell();
           })
      .add(forData(flag("shared")), &ParameterRow::shared)
      .add(forData(interval("bound")), &ParameterRow::bounds)
      .add(ifAny(text("prior")), &ParameterRow::prior);
}

ResultTable conditionTable(const FitAnswer& answer) {
  const FitSettings& settings = answer.fit.settings;
  const bool map = settings.method == FitMethod::MaximumPosterior;
  const auto sigmoid = [&](auto of) {
    return [&, of](const ConditionFit& fit) { return of(fit.sigmoid(settings)); };
  };
  using psychometrics::Sigmoid;
  return TableOf("conditions", "", answer.fit.conditions)
      .add(ifAny(text("condition")), &ConditionFit::name)
      .add(integer("trials"), &ConditionFit::trials)
      .add(integer("blocks", "levels or blocks"), &ConditionFit::blocks)
      .add(number("deviance", "", 2), &ConditionFit::deviance)
      .add(number("log_likelihood", "", 2), &ConditionFit::logLikelihood)
      // Priors of a parameter that conditions share have no condition of their own.
      .add(forData(number("log_posterior")),
           [=](const ConditionFit& fit) {
             return map ? ResultCell(fit.logLikelihood + fit.logPrior) : ResultCell();
           })
      // Of x, where the sigmoid is one of -x or 1/x.
      .add(forData(number("location")),
           sigmoid([&](const Sigmoid& one) { return settings.falling ? -one.location() : one.location(); }))
      .add(forData(number("scale")), sigmoid([](const Sigmoid& one) { return one.scale(); }))
      .add(forData(number("alpha")), sigmoid([&](const Sigmoid& one) {
             if (!settings.falling) return one.alpha();
             return settings.logarithmic() ? std::exp(-one.location()) : -one.location();
           }))
      .add(forData(number("beta")), sigmoid([](const Sigmoid& one) { return one.beta(); }));
}

void addGoodness(const FitAnswer& answer, Section& out) {
  struct TestRow {
    std::string condition;
    const char* name;
    MonteCarloTest test;
    bool upperOnly;
  };
  struct BlockRow {
    std::string condition;
    double level, predicted, residual;
    BlockInfluence influence;
  };
  std::vector<TestRow> tests;
  std::vector<BlockRow> blocks;
  for (size_t c = 0; c < answer.goodness.size(); ++c) {
    const Goodness& goodness = answer.goodness[c];
    const std::string& name = answer.fit.conditions[c].name;
    tests.push_back({name, "deviance", goodness.deviance, true});
    tests.push_back({name, "residuals with prediction", goodness.withPrediction, false});
    tests.push_back({name, "residuals with order", goodness.withOrder, false});
    for (size_t i = 0; i < goodness.influences.size(); ++i)
      blocks.push_back({name, goodness.residuals.levels[i], goodness.residuals.predicted[i],
                        goodness.residuals.values[i], goodness.influences[i]});
  }
  if (tests.empty()) return;
  out.add(TableOf("goodness",
                  fmt::format("goodness of fit: {} samples, seed {}", answer.samples, answer.seed), tests)
              .add(ifAny(text("condition")), &TestRow::condition)
              .add(text("statistic"), &TestRow::name)
              .add(significant("value"), at(&TestRow::test, &MonteCarloTest::value))
              .add(significant("limit_low", "95 % of samples from"),
                   [](const TestRow& row) { return row.upperOnly ? ResultCell() : ResultCell(row.test.low); })
              .add(significant("limit_high", "to"), at(&TestRow::test, &MonteCarloTest::high))
              .add(probability(), at(&TestRow::test, &MonteCarloTest::p)));
  const auto without = [](double BlockInfluence::*member) {
    return [member](const BlockRow& row) {
      return row.influence.refused ? ResultCell() : ResultCell(row.influence.*member);
    };
  };
  out.add(
      TableOf("blocks", "residuals of blocks, and the fit without each", blocks)
          .add(ifAny(text("condition")), &BlockRow::condition)
          .add(significant("level"),
               [](const BlockRow& row) {
                 return std::isfinite(row.level) ? ResultCell(row.level) : ResultCell();
               })
          .add(forData(flag("no_stimulus")), [](const BlockRow& row) { return !std::isfinite(row.level); })
          .add(number("predicted", "", 4), &BlockRow::predicted)
          .add(number("deviance_residual", "residual"), &BlockRow::residual)
          .add(significant("threshold_without", "threshold"), without(&BlockInfluence::threshold))
          .add(significant("width_without", "width"), without(&BlockInfluence::width))
          .add(flag("influential"), at(&BlockRow::influence, &BlockInfluence::influential)));
}

void addModels(const FitAnswer& answer, Section& out) {
  struct ModelRow {
    const char* name;
    const Fit* fit;
  };
  std::vector<ModelRow> rows = {{answer.full ? "shared" : "all", &answer.fit}};
  if (answer.full) rows.push_back({"not shared", &*answer.full});
  const bool map = answer.fit.settings.method == FitMethod::MaximumPosterior;
  out.add(TableOf("models", "", rows)
              .add(text("model"), &ModelRow::name)
              .add(integer("parameters"), at(&ModelRow::fit, &Fit::freeParameters))
              .add(number("log_likelihood", "", 2), at(&ModelRow::fit, &Fit::logLikelihood))
              .add(number("deviance", "", 2), at(&ModelRow::fit, &Fit::deviance))
              .add(number("aic", "AIC", 2), at(&ModelRow::fit, &Fit::aic))
              .add(number("bic", "BIC", 2), at(&ModelRow::fit, &Fit::bic))
              .add(ifAny(number("log_posterior", "", 2)), [=](const ModelRow& row) {
                return map ? ResultCell(row.fit->logPosterior()) : ResultCell();
              }));
  if (!answer.ratio) return;
  out.add(TableOf("likelihood_ratio", "likelihood ratio, shared within not shared",
                  std::vector<LikelihoodRatio>{*answer.ratio})
              .add(number("statistic", "χ²", 2), &LikelihoodRatio::statistic)
              .add(integer("df"), &LikelihoodRatio::degrees)
              .add(probability(), &LikelihoodRatio::p));
  out.notes.push_back("likelihood ratio: approximate for few trials; rates at a bound make p too large");
}

void addSettings(const FitAnswer& answer, Section& out) {
  const FitSettings& settings = answer.fit.settings;
  out.fact(key(text("part")), answer.part.empty() ? ResultCell() : ResultCell(answer.part));
  out.fact(forData(text("x")), answer.level);
  out.fact(text("task"), nameOf(settings.task));
  out.fact(text("sigmoid"), psychometrics::nameOf(settings.sigmoid));
  out.fact(text("axis"), settings.logarithmic() ? "log" : "linear");
  out.fact(text("direction"), settings.falling ? "falling" : "rising");
  out.fact(text("method"), toText(settings.method));
  out.fact(significant("threshold_level", "threshold at F ="), settings.thresholdLevel);
  out.fact(significant("width_from", settings.logarithmic() ? "width in ln x, from F =" : "width from F ="),
           0.05);
  out.fact(significant("width_to", "to F ="), 0.95);
  out.fact(forData(flag("overdispersion")), settings.overdispersion);
  if (!answer.intervals) return;
  const FitIntervals& intervals = *answer.intervals;
  out.fact(text("interval_method", "intervals"), toText(intervals.method));
  out.fact(significant("level"), intervals.confidence);
  if (intervals.method != IntervalMethod::Bootstrap && intervals.method != IntervalMethod::Bca) return;
  out.fact(text("resampling"), answer.parametric ? "parametric" : "nonparametric");
  out.fact(integer("samples"), answer.samples);
  out.fact(integer("seed"), answer.seed);
}

}  // namespace

const std::string& quantityName(size_t quantity) {
  static const std::string kSlope = "slope";
  return quantity < kFitParameters ? fitParameterNames()[quantity] : kSlope;
}

std::vector<std::string> remarksOn(const FitAnswer& answer) {
  std::vector<std::string> out = answer.notes;
  if (answer.intervals) {
    const FitIntervals& intervals = *answer.intervals;
    for (const std::string& note :
         coverageNotes(intervals.method, answer.parametric, answer.fit.settings.task))
      out.push_back(note);
    out.insert(out.end(), intervals.warnings.begin(), intervals.warnings.end());
  }
  for (const ConditionFit& fit : answer.fit.conditions)
    for (const std::string& warning : fit.warnings) out.push_back(fit.prefix() + warning);
  return out;
}

Section sectionOf(const FitAnswer& answer) {
  Section out;
  out.title = "psychometric function of " + answer.level +
              (answer.part.empty() ? "" : ", part " + answer.part) + ": P = guess + (1 - guess - lapse) F";
  addSettings(answer, out);
  out.add(parameterTable(answer));
  out.add(conditionTable(answer));
  addGoodness(answer, out);
  addModels(answer, out);
  std::vector<std::string> held, shared;
  const FitSettings& settings = answer.fit.settings;
  for (size_t i = 0; i < kFitParameters; ++i) {
    if (settings.fixed[i])
      held.push_back(fitParameterNames()[i] + " = " + shortestNumber(*settings.fixed[i]));
    if (settings.shared[i]) shared.push_back(fitParameterNames()[i]);
  }
  if (!held.empty()) out.notes.push_back("fixed: " + join(held));
  if (!shared.empty()) out.notes.push_back("shared by all conditions: " + join(shared));
  for (const std::string& remark : remarksOn(answer)) out.notes.push_back("note: " + remark);
  out.notes.push_back("slope: dF/dx at the threshold");
  return out;
}

Result resultOf(const std::vector<FitAnswer>& answers) {
  Result out;
  out.command = "fit";
  for (const FitAnswer& answer : answers) out.sections.push_back(sectionOf(answer));
  std::vector<std::array<std::string, 2>> versions = fitLibraries();
  versions.insert(versions.begin(), {{"limen", projectVersion()}, {"commit", buildCommit()}});
  out.head.add(TableOf("versions", "", versions)
                   .add(forData(text("name")), [](const auto& one) { return one[0]; })
                   .add(forData(text("version")), [](const auto& one) { return one[1]; }));
  out.notes.push_back("limen-analyse " + projectVersion() + ", commit " + buildCommit());
  return out;
}

}  // namespace limen::analysis
