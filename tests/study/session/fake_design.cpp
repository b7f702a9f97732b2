// SPDX-License-Identifier: BSD-3-Clause
// A plain planner and stimuli without graphics: for tests of sessions, which take any plan.
#include <nlohmann/json.hpp>

#include "base/hash.h"
#include "psychometrics/random.h"
#include "study/procedures/procedure.h"
#include "study/protocol/design.h"

namespace limen::study {
namespace {

using Condition = std::map<std::string, std::string>;

std::vector<std::pair<Condition, Variables>> conditionsOf(const Part& part) {
  std::vector<std::pair<Condition, Variables>> all{{{}, part.variables}};
  for (const Factor& factor : part.factors) {
    std::vector<std::pair<Condition, Variables>> next;
    for (const auto& [condition, variables] : all) {
      for (const FactorLevel& level : factor.levels) {
        auto [c, v] = std::pair(condition, variables);
        c[factor.name] = level.name;
        for (const auto& [name, value] : level.variables) v[name] = value;
        next.emplace_back(c, v);
      }
    }
    all = next;
  }
  return all;
}

PlannedBlock practiceBlock(const Protocol& protocol, int index, uint64_t seed, int round, int& number) {
  const Part& part = protocol.parts[static_cast<size_t>(index)];
  PlannedBlock block{index, part.name + ": practice", true, {}};
  psychometrics::Random random(psychometrics::childSeed(seed, part.name + ":" + std::to_string(round)));
  const auto conditions = conditionsOf(part);
  for (int i = 0; i < part.practice.trials; ++i) {
    PlannedTrial trial;
    trial.number = number++;
    trial.part = index;
    trial.practice = true;
    std::tie(trial.condition, trial.variables) = conditions[static_cast<size_t>(i) % conditions.size()];
    trial.target = static_cast<int>(random.below(2));
    block.trials.push_back(trial);
  }
  return block;
}

}  // namespace

Design makeDesign(const Protocol& protocol, uint64_t seed, int participantNumber) {
  Design design;
  int number = 0;
  for (int index = 0; index < static_cast<int>(protocol.parts.size()); ++index) {
    const Part& part = protocol.parts[static_cast<size_t>(index)];
    psychometrics::Random random(
        psychometrics::childSeed(seed, part.name + ":" + std::to_string(participantNumber)));
    if (part.practice.trials > 0) design.blocks.push_back(practiceBlock(protocol, index, seed, 0, number));
    std::vector<PlannedTrial> trials;
    for (const auto& [condition, variables] : conditionsOf(part)) {
      PlannedTrial trial;
      trial.part = index;
      trial.condition = condition;
      trial.variables = variables;
      int changes = part.changeRepetitions;
      if (part.procedure) {
        trial.procedure = static_cast<int>(design.procedures.size());
        design.procedures.push_back({index, condition, part.procedure->settings, random.bits()});
        changes = *readProcedure(part.procedure->settings, "test").mostTrials;
      }
      for (int i = 0; i < changes + part.catchRepetitions; ++i) {
        trial.change = i < changes;
        trial.repetition = i;
        trial.target = static_cast<int>(random.below(2));
        trials.push_back(trial);
      }
    }
    const size_t blocks = part.blockBy.empty() ? 1 : 2;  // any blockBy: two halves
    random.shuffle(trials);
    for (size_t b = 0; b < blocks; ++b) {
      PlannedBlock block{index, part.name + ": " + std::to_string(b), false, {}};
      for (size_t i = trials.size() * b / blocks; i < trials.size() * (b + 1) / blocks; ++i) {
        trials[i].number = number++;
        block.trials.push_back(trials[i]);
      }
      design.blocks.push_back(block);
    }
  }
  return design;
}

PlannedBlock makePracticeRound(const Protocol& protocol, int part, uint64_t seed, int round) {
  int number = 10000 * (part + 1) + 1000 * round;
  return practiceBlock(protocol, part, seed, round, number);
}

std::vector<Stimulus> stimuliOf(const Protocol& protocol, const PlannedTrial& trial, const Variables& axes) {
  const Task task = protocol.parts[static_cast<size_t>(trial.part)].task.type;
  const bool two = task != Task::YesNo && task != Task::Rating;
  std::vector<Stimulus> stimuli(two ? 2 : 1);
  for (size_t i = 0; i < stimuli.size(); ++i) {
    stimuli[i].scene.name = "test/" + nlohmann::json(trial.variables).dump() + nlohmann::json(axes).dump();
    stimuli[i].changes = two ? static_cast<int>(i) == trial.target : trial.change;
  }
  return stimuli;
}

nlohmann::json toJson(const Stimulus& stimulus) {
  return {{"scene", stimulus.scene.name}, {"changes", stimulus.changes}};
}

std::string stimulusHash(const Stimulus& stimulus) { return sha256(toJson(stimulus).dump()); }

}  // namespace limen::study
