// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/observer_statistics/mixed.h"

#include "analysis/answer_tables/levels.h"
#include "analysis/observer_statistics/mixed_design.h"
#include "experiments/base/error.h"

namespace limen::analysis {

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

}  // namespace limen::analysis
