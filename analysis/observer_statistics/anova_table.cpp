// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/observer_statistics/anova.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "analysis/answer_tables/levels.h"
#include "experiments/base/error.h"

namespace limen::analysis {
namespace {

std::vector<std::string> labelsIn(const Table& table, size_t column) {
  std::vector<std::string> out;
  for (size_t row = 0; row < table.rows(); ++row) out.push_back(readLabel(table, row, column));
  return out;
}

/// Whether some subject was measured at two levels of the factor.
bool variesWithin(const GroupObservations& data, size_t factor) {
  std::vector<std::set<size_t>> seen(data.subjects.size());
  for (const CellObservation& one : data.observations) seen[one.subject].insert(one.levels[factor]);
  return std::any_of(seen.begin(), seen.end(), [](const auto& levels) { return levels.size() > 1; });
}

}  // namespace

GroupObservations readGroupObservations(const Table& table, const AnovaColumns& columns) {
  if (columns.subject.empty())
    throw Error("the column that says who answered is not named", table.name(), "give --subject");
  if (columns.within.empty())
    throw Error("no factor is named", table.name(), "give --within with the columns of conditions");
  const AnswerReader answers(table, columns.answers, true);
  std::set<std::string> used = {columns.subject, columns.answers.outcome, columns.answers.correct,
                                columns.answers.trials, columns.answers.value};
  GroupObservations out;
  const Levels subjects = namesIn(labelsIn(table, table.column(columns.subject, "--subject")));
  out.subjects = subjects.names;
  std::vector<Levels> levels;
  for (const std::string& name : columns.within) {
    const size_t column = table.column(name, "--within");
    if (!used.insert(name).second) throw Error("column '" + name + "' is named twice", "--within");
    levels.push_back(levelsIn(labelsIn(table, column)));
    out.factors.push_back({name, levels.back().names});
    if (levels.back().names.size() < 2)
      throw Error("column '" + name + "' has one level, '" + levels.back().names[0] + "'",
                  table.name() + " (--within)", "leave it out");
  }
  if (out.subjects.size() < 2)
    throw Error("column '" + columns.subject + "' has one subject, '" + out.subjects[0] + "'", table.name(),
                "effects are tested against how subjects differ, which takes two at least");
  for (size_t row = 0; row < table.rows(); ++row) {
    CellObservation one;
    one.subject = subjects.ofRow[row];
    for (const Levels& factor : levels) one.levels.push_back(factor.ofRow[row]);
    one.value = answers.value(row);
    if (answers.counts()) one.weight = static_cast<double>(answers.count(row).trials);
    out.observations.push_back(std::move(one));
  }
  for (size_t factor = 0; factor < out.factors.size(); ++factor)
    if (!variesWithin(out, factor))
      throw Error("no subject has more than one level of '" + out.factors[factor].name + "'",
                  table.name() + " (--within)",
                  "it lies between subjects, which this analysis does not take; leave it out");
  return out;
}

PartAnova tableAnova(const Table& table, const AnovaColumns& columns, const AnovaSettings& settings) {
  const GroupObservations data = readGroupObservations(table, columns);
  const std::vector<IncompleteSubject> incomplete = incompleteSubjects(data);
  const std::string remedy = "complete them, or leave such subjects out with --drop-incomplete";
  if (!incomplete.empty() && !columns.dropIncomplete) {
    const IncompleteSubject& first = incomplete.front();
    std::string what = "subject '" + data.subjects[first.subject] + "' has no value at " +
                       cellName(data.factors, first.first);
    if (first.missing > 1) what += fmt::format(" and {} more cells", first.missing - 1);
    if (incomplete.size() > 1) what += fmt::format("; {} subjects miss some cell", incomplete.size());
    throw Error(what, table.name(), remedy);
  }
  if (incomplete.size() + 2 > data.subjects.size())
    throw Error(fmt::format("{} of {} subjects miss some cell, fewer than two are left", incomplete.size(),
                            data.subjects.size()),
                table.name(), "reduce --within, or take rows of fewer levels with --where");
  PartAnova out;
  const AnswerReader answers(table, columns.answers, true);
  if (settings.transform == RateTransform::Arcsine)
    for (size_t row = 0; row < table.rows(); ++row)
      if (const double value = answers.value(row); !(value >= 0.0 && value <= 1.0))
        throw Error(fmt::format("{} is no rate, which the arcsine transform is for", value),
                    answers.place(row), "transform rates from 0 to 1 only");
  out.of = answers.column();
  out.measure = answers.meaning();
  out.rates = answers.counts();
  analyseGroup(out, data, settings);
  return out;
}

}  // namespace limen::analysis
