// SPDX-License-Identifier: BSD-3-Clause
#include "study/protocol/blocks.h"

#include <cassert>
#include <numeric>

#include "experiments/base/yaml_tree.h"
#include "study/procedures/procedure.h"
#include "study/protocol/conditions.h"

namespace limen::study {
namespace {

using psychometrics::Random;

/// Deals 0 ... choices - 1 to the members of each group, equally often within a group, with the remainder
/// drawn so that it evens out over the groups. Groups of pointers to trials; `put` receives trial and choice.
template <class Put>
void deal(const std::map<std::string, std::vector<PlannedTrial*>>& groups, size_t choices, Random& random,
          Put put) {
  std::vector<int> deck;  // the remainder is drawn from here, without replacement until it is empty
  for (const auto& [name, group] : groups) {
    std::vector<int> dealt;
    while (dealt.size() + choices <= group.size())
      for (size_t a = 0; a < choices; ++a) dealt.push_back(static_cast<int>(a));
    const size_t full = dealt.size();
    std::vector<int> later;
    while (dealt.size() < group.size()) {
      if (deck.empty()) {
        deck.resize(choices);
        std::iota(deck.begin(), deck.end(), 0);
        random.shuffle(deck);
      }
      const int next = deck.back();
      deck.pop_back();
      bool fresh = true;  // nothing is in the remainder twice for one group
      for (size_t i = full; i < dealt.size(); ++i) fresh = fresh && dealt[i] != next;
      (fresh ? dealt : later).push_back(next);
    }
    deck.insert(deck.end(), later.begin(), later.end());
    random.shuffle(dealt);
    for (size_t i = 0; i < dealt.size(); ++i) put(*group[i], dealt[i]);
  }
}

bool hasTargets(const Part& part) {
  return part.task.type == Task::Interval || part.task.type == Task::Alternative;
}

void addAdaptive(PlannedBlock& block, PlannedTrial trial, int mostTrials, int catches) {
  for (trial.repetition = 0; trial.repetition < mostTrials; ++trial.repetition) block.trials.push_back(trial);
  trial.change = false;
  for (trial.repetition = 0; trial.repetition < catches; ++trial.repetition) block.trials.push_back(trial);
}

void addConstant(const Part& part, PlannedBlock& block, PlannedTrial trial) {
  const int changes = part.changeRepetitions;
  if (const Factor* items = itemsOf(part)) {
    for (const auto& [a, b] : pairsOf(*items))
      for (trial.repetition = 0; trial.repetition < changes; ++trial.repetition)
        for (trial.target = 0; trial.target < 2; ++trial.target) {
          trial.condition["item_a"] = items->levels[a].name;
          trial.condition["item_b"] = items->levels[b].name;
          block.trials.push_back(trial);
        }
    return;
  }
  for (trial.repetition = 0; trial.repetition < changes; ++trial.repetition) block.trials.push_back(trial);
  trial.change = false;
  for (trial.repetition = 0; trial.repetition < part.catchRepetitions; ++trial.repetition)
    block.trials.push_back(trial);
}

}  // namespace

std::vector<PlannedBlock> unorderedBlocks(const Part& part, int partNumber, int firstProcedure) {
  int mostTrials = 0;
  if (part.procedure) mostTrials = *readProcedure(part.procedure->settings, "procedure").mostTrials;
  std::vector<PlannedBlock> out;
  const size_t blocks = part.blockBy.empty() ? 1 : part.blockLevels.size();
  for (size_t i = 0; i < blocks; ++i)
    out.push_back(
        {partNumber, part.blockBy.empty() ? part.name : part.name + ": " + part.blockLevels[i], false, {}});

  const std::vector<Condition> conditions = conditionsOf(part);
  const auto count = static_cast<int>(conditions.size());
  for (int c = 0; c < count; ++c) {
    const Condition& condition = conditions[static_cast<size_t>(c)];
    PlannedTrial trial;
    trial.part = partNumber;
    trial.condition = condition.levels;
    trial.variables = condition.variables;
    size_t block = 0;
    while (!part.blockBy.empty() && part.blockLevels[block] != condition.levels.at(part.blockBy)) ++block;
    if (part.procedure) {
      trial.procedure = firstProcedure + c;
      // Of n catch trials condition c has those from n c / count to n (c + 1) / count.
      const int64_t n = part.catchRepetitions;
      addAdaptive(out[block], trial, mostTrials, static_cast<int>(n * (c + 1) / count - n * c / count));
    } else {
      addConstant(part, out[block], trial);
    }
  }
  return out;
}

std::vector<RunLimit> runLimits(const Part& part, const std::vector<PlannedTrial>& trials) {
  std::vector<RunLimit> out;
  for (const auto& [name, atMost] : part.trialOrder.atMostInARow) {
    RunLimit limit{{}, atMost};
    std::map<std::string, int> numbers;
    for (const PlannedTrial& trial : trials) {
      const std::string value = name == "change" ? (trial.change ? "1" : "0") : trial.condition.at(name);
      limit.values.push_back(numbers.emplace(value, static_cast<int>(numbers.size())).first->second);
    }
    out.push_back(std::move(limit));
  }
  return out;
}

size_t trialCount(const Part& part) {
  size_t out = 0;
  for (const PlannedBlock& block : unorderedBlocks(part, 0, 0)) out += block.trials.size();
  return out;
}

void setTargets(const Part& part, std::vector<PlannedTrial>& trials, uint64_t seed) {
  if (!hasTargets(part)) return;
  Random random(seed);
  std::map<std::string, std::vector<PlannedTrial*>> conditions;
  for (PlannedTrial& trial : trials) conditions[nameOf(part, trial.condition)].push_back(&trial);
  deal(conditions, static_cast<size_t>(part.task.alternatives), random,
       [](PlannedTrial& trial, int choice) { trial.target = choice; });
}

void setUnchanged(const Part& part, std::vector<PlannedTrial>& trials, uint64_t seed) {
  Random random(seed);
  std::map<std::string, std::vector<PlannedTrial*>> conditions;
  for (PlannedTrial& trial : trials)
    if (hasTargets(part) || !trial.change) conditions[nameOf(part, trial.condition)].push_back(&trial);
  deal(conditions, 2, random,
       [](PlannedTrial& trial, int choice) { trial.unchangedShowsAfter = choice == 1; });
}

}  // namespace limen::study
