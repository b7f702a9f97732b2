// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/problems.h"
#include "study/protocol/conditions.h"
#include "study/protocol/design.h"
#include "study/protocol/stimulus_reader.h"

namespace limen::study {

std::vector<Stimulus> stimuliOf(const Protocol& protocol, const PlannedTrial& trial, const Variables& axes) {
  const Part& part = protocol.parts.at(static_cast<size_t>(trial.part));
  Problems problems(protocol.path);
  FileFinder files = *protocol.files;
  NodeReader reader(problems, files);
  StimulusReader stimuli(reader, *protocol.catalogue);
  const Variables variables = merged(trial.variables, axes);
  const auto read = [&](const Variables& all) {
    std::optional<Stimulus> out = stimuli.read(part.stimulus, all);
    problems.throwIfAny();
    return *out;
  };

  if (const Factor* items = itemsOf(part)) {
    std::vector<Stimulus> out;
    for (int place = 0; place < 2; ++place) {
      const std::string& name = trial.condition.at(place == trial.target ? "item_b" : "item_a");
      for (const FactorLevel& level : items->levels)
        if (level.name == name) out.push_back(read(merged(variables, level.variables)));
    }
    return out;
  }
  Stimulus stimulus = read(variables);
  const bool changes = stimulus.changes, balanced = stimuli.balancesUnchanged();
  bool showsAfter = trial.unchangedShowsAfter.value_or(false);
  const auto setChange = [&](Stimulus& one, bool due) {
    one.changes = changes && due;
    if (!changes || due || !balanced) return;
    one.catchShowsAfter = showsAfter;
    if (trial.unchangedShowsAfter) showsAfter = !showsAfter;
  };
  if (part.task.type == Task::YesNo || part.task.type == Task::Rating) {
    setChange(stimulus, trial.change);
    return {stimulus};
  }
  std::vector<Stimulus> out(static_cast<size_t>(part.task.alternatives), stimulus);
  for (size_t i = 0; i < out.size(); ++i) setChange(out[i], static_cast<int>(i) == trial.target);
  return out;
}

}  // namespace limen::study
