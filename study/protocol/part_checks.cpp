// SPDX-License-Identifier: BSD-3-Clause
// Checks of a part as a whole: name clashes, conditions without a stimulus, orders that do not exist.
#include <fmt/format.h>

#include <algorithm>

#include "experiments/base/text.h"
#include "study/protocol/blocks.h"
#include "study/protocol/conditions.h"
#include "study/protocol/order.h"
#include "study/protocol/part_reader.h"
#include "study/protocol/stimulus_reader.h"

namespace limen::study {
namespace {

/// Least and largest values of a procedure's axes, in all combinations.
std::vector<Variables> corners(const ProcedureSettings& procedure) {
  std::vector<Variables> out = {{}};
  for (const StimulusDimension& dimension : procedure.stimulus) {
    std::vector<Variables> more;
    for (const Variables& corner : out)
      for (const double value : {dimension.minimum, dimension.maximum})
        more.push_back(merged(corner, {{dimension.name, value}}));
    out = std::move(more);
  }
  return out;
}

}  // namespace

void PartReader::checkNames(const Part& part, Mark mark) {
  std::map<std::string, std::string> setBy = {{"refresh_hz", "the display"}};
  const auto note = [&](const std::string& variable, const std::string& by) {
    const auto [known, fresh] = setBy.emplace(variable, by);
    if (!fresh)
      reader_.problems().add(mark,
                             fmt::format("variable '{}' is set by {} and by {}", variable, known->second, by),
                             "rename one");
  };
  for (const auto& [name, value] : part.variables) note(name, "'variables'");
  for (const Factor& factor : part.factors)
    for (const auto& [name, value] : factor.levels.front().variables)
      note(name, "factor '" + factor.name + "'");
  if (procedure_)
    for (const StimulusDimension& dimension : procedure_->stimulus) note(dimension.name, "the procedure");
}

void PartReader::checkSize(const Part& part, Mark mark) {
  constexpr double kMostTrials = 20000.0;  // more than a day without a break
  double conditions = 1.0, pairs = 1.0;
  for (const Factor& factor : part.factors) {
    const auto levels = static_cast<double>(factor.levels.size());
    if (&factor == itemsOf(part))
      pairs = levels * (levels - 1.0);
    else
      conditions *= levels;
  }
  const double each = procedure_ ? static_cast<double>(procedure_->mostTrials.value_or(0))
                                 : pairs * part.changeRepetitions + part.catchRepetitions;
  const double trials = conditions * each + (procedure_ ? part.catchRepetitions : 0.0);
  if (trials > kMostTrials)
    reader_.problems().add(mark,
                           fmt::format("part '{}' has {} conditions and {} trials", part.name,
                                       shortestNumber(conditions), shortestNumber(trials)),
                           "keep to " + shortestNumber(kMostTrials) + " trials");
}

void PartReader::checkStimuli(const Part& part) {
  StimulusReader stimuli(reader_, catalogue_);
  std::vector<Variables> sets = {{}};
  if (procedure_) {
    sets = corners(*procedure_);
    sets.insert(sets.end(), part.practice.stimuli.begin(), part.practice.stimuli.end());
  }
  if (const Factor* items = itemsOf(part)) {
    sets.clear();
    for (const FactorLevel& level : items->levels) sets.push_back(level.variables);
  }
  const bool needsChange = part.task.type == Task::YesNo || part.task.type == Task::Interval ||
                           part.task.type == Task::Alternative;
  for (const Condition& condition : conditionsOf(part))
    for (const Variables& more : sets) {
      const auto stimulus = stimuli.read(part.stimulus, merged(condition.variables, more));
      if (stimulus && needsChange && !stimulus->changes)
        reader_.problems().add(
            part.stimulus.node.mark,
            "nothing changes in the stimuli of a task '" + std::string(limen::toText(part.task.type)) + "'",
            "give 'levels: {before: 1, after: 0}', or 'before' and 'after'");
    }
}

void PartReader::checkOrders(const Part& part, Mark mark) {
  if (part.trialOrder.atMostInARow.empty()) return;
  for (const PlannedBlock& block : unorderedBlocks(part, 0, 0)) {
    const Feasibility found = feasibility(block.trials.size(), runLimits(part, block.trials));
    if (found == Feasibility::Possible) continue;
    const std::string which = fmt::format("of the {} trials of block '{}'", block.trials.size(), block.name);
    reader_.problems().add(
        mark,
        found == Feasibility::Impossible
            ? "no order " + which + " keeps 'at_most_in_a_row'"
            : "no order " + which + " that keeps 'at_most_in_a_row' was found in a bounded search",
        "allow longer runs, or limit fewer things");
  }
}

}  // namespace limen::study
