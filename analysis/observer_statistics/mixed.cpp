// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/observer_statistics/mixed.h"

#include <cmath>

#include "analysis/answer_tables/levels.h"
#include "experiments/base/error.h"

namespace limen::analysis {

MixedRows readMixedRows(const Table& table, const std::string& group, const AnswerColumns& columns) {
  if (group.empty())
    throw Error("the column that says who answered is not named", table.name(), "give --group");
  const size_t own = table.column(group, "--group");
  const AnswerReader answers(table, columns);
  MixedRows out;
  out.measure = answers.meaning();
  out.group = group;
  for (size_t row = 0; row < table.rows(); ++row) {
    out.groups.push_back(readLabel(table, row, own));
    out.answers.push_back(answers.count(row));
    for (size_t column = 0; column < table.header().size(); ++column)
      out.columns[table.header()[column]].push_back(table.text(row, column));
  }
  out.place = [&table](size_t row, const std::string& column) {
    return table.place(row, table.column(column));
  };
  return out;
}

MixedModel fitMixedModel(const MixedRows& rows, const MixedTerms& terms) {
  const MixedDesign design = buildDesign(rows, terms);
  const Levels groups = namesIn(rows.groups);
  if (groups.names.size() < 2)
    throw Error("all rows are of one " + rows.group + ", '" + groups.names.at(0) + "'", "--group",
                "what groups have in common takes two at least");
  MixedModel out;
  out.measure = rows.measure;
  out.group = rows.group;
  out.rows = rows.answers.size();
  out.columns = design.sources;
  out.groups = groups.names;
  MixedLogisticData data;
  data.groups = groups.ofRow;
  data.columns = {"intercept"};
  data.columns.insert(data.columns.end(), design.names.begin(), design.names.end());
  for (size_t row = 0; row < rows.answers.size(); ++row) {
    out.successes += rows.answers[row].correct;
    out.trials += rows.answers[row].trials;
    data.successes.push_back(rows.answers[row].correct);
    data.trials.push_back(rows.answers[row].trials);
    data.design.push_back(1.0);
    for (const std::vector<double>& column : design.columns) data.design.push_back(column[row]);
  }
  MixedLogisticOptions options;
  if (!terms.slope.empty()) {
    options.random = RandomEffects::kInterceptAndSlope;
    options.slopeColumn = 1 + design.slope;
    out.slope = design.names[design.slope];
  }
  out.fit = fitMixedLogistic(data, options);
  return out;
}

namespace {

/// What the optimiser leaves of an estimate of 0 is far below its error.
ResultCell shown(double value, double error) { return std::abs(value) < 1e-8 * error ? 0.0 : value; }

struct RandomRow {
  std::string name;
  std::optional<double> value;
};

}  // namespace

Result resultOf(const MixedModel& model) {
  const MixedLogistic& fit = model.fit;
  Section out;
  out.title = "mixed-effects logistic regression, " + model.measure;
  out.fact(forData(text("measure")), model.measure);
  out.fact(text("group"), model.group);
  out.fact(integer("groups_in_model", "groups"), model.groups.size());
  out.fact(integer("rows"), model.rows);
  out.fact(count("successes", "trials", "answers of 1"), CountOf{model.successes, model.trials});
  out.fact(forPeople(share("", "share")),
           static_cast<double>(model.successes) / static_cast<double>(model.trials));
  out.fact(significant("log_likelihood", "", 6), fit.logLikelihood);
  out.fact(significant("aic", "AIC", 6), fit.aic);
  out.fact(forData(flag("singular")), fit.singular);
  out.fact(forData(text("slope")), model.slope.empty() ? ResultCell() : ResultCell(model.slope));
  out.fact(forData(text("note")), fit.note);
  out.add(TableOf("columns", "", model.columns)
              .add(text("name", "column"), &ModelColumn::name)
              .add(forData(flag("numeric")), &ModelColumn::numeric)
              .add(ifAny(list("levels")), &ModelColumn::levels)
              .add(ifAny(text("reference")),
                   [](const ModelColumn& one) { return one.numeric ? ResultCell() : one.levels[0]; })
              .add(forData(flag("logarithm")), when(&ModelColumn::numeric, &ModelColumn::logarithmic))
              .add(ifAny(significant("centre", "minus (mean over rows)", 6)),
                   when(&ModelColumn::centred, &ModelColumn::centre))
              .add(forPeople(text("", "coded as")), [](const ModelColumn& one) {
                return one.numeric ? std::string(one.logarithmic ? "numbers, natural logarithm" : "numbers")
                                   : one.levels[0] + " is 0";
              }));
  const auto ratio = [](double logOdds) { return std::exp(logOdds); };
  out.add(TableOf("fixed", "fixed effects", fit.fixed)
              .add(text("name", "effect"), &FixedEffect::name)
              .add(significant("estimate"),
                   [](const FixedEffect& one) { return shown(one.estimate, one.standardError); })
              .add(interval(), &FixedEffect::interval)
              .add(significant("standard_error", "error"), &FixedEffect::standardError)
              .add(number("z"), [](const FixedEffect& one) { return shown(one.z, 1.0); })
              .add(probability(), &FixedEffect::p)
              .add(significant("odds_ratio"), [&](const FixedEffect& one) { return ratio(one.estimate); })
              .add(interval("odds_ratio"), [&](const FixedEffect& one) {
                return Interval{ratio(one.interval.low), ratio(one.interval.high)};
              }));
  std::vector<RandomRow> random = {{"intercept_sd", fit.interceptDeviation}};
  if (!model.slope.empty()) {
    random.push_back({"slope_sd", fit.slopeDeviation});
    random.push_back({"correlation", fit.correlation});
  }
  out.add(TableOf("random", "random effect of " + model.group, random)
              .add(text("name", "parameter"), &RandomRow::name)
              .add(significant("estimate"), &RandomRow::value));
  const auto group = [&](const GroupEffect& one) { return model.groups[one.group]; };
  out.add(TableOf("groups", model.group + ": deviations from the fixed effects", fit.groups)
              .add(text("group", model.group), group)
              .add(number("intercept"), &GroupEffect::intercept)
              .addIf(!model.slope.empty(), number("slope"), &GroupEffect::slope));
  if (!fit.note.empty()) out.notes.push_back("note: " + fit.note);
  out.notes.push_back("ln(p / (1 - p)) = fixed effects + what each " + model.group +
                      " adds to the intercept" +
                      (model.slope.empty() ? "" : " and to the slope along " + model.slope));
  out.notes.push_back("maximum likelihood by Laplace's approximation; z tests and 95 % intervals after Wald");
  Result result;
  result.command = "mixed";
  result.sections.push_back(std::move(out));
  return result;
}

}  // namespace limen::analysis
