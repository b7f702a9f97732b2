// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <set>

#include "tests/experiments/base/declare.h"
#include "tests/study/protocol/example.h"

namespace limen::study {
namespace {

const std::string kPracticeFactors =
    "factors: {distance: [4, 6, 9], kind: [wood, stone], presentation: [dynamic, static]}\n";

std::map<std::map<std::string, std::string>, int> drawn(const PlannedBlock& block) {
  std::map<std::map<std::string, std::string>, int> out;
  for (const PlannedTrial& trial : block.trials) ++out[trial.condition];
  return out;
}

TEST(Practice, DrawsEvenlyFromTheConditions) {
  for (const int trials : {1, 5, 12, 24, 31}) {
    const Protocol protocol = exampleProtocol(kYesNo + kBox + kPracticeFactors +
                                              "practice: {trials: " + std::to_string(trials) + "}\n");
    for (uint64_t seed = 0; seed < 20; ++seed) {
      const PlannedBlock block = makePracticeRound(protocol, 0, seed, 0);
      ASSERT_EQ(block.trials.size(), static_cast<size_t>(trials));
      EXPECT_TRUE(block.practice);
      const auto counts = drawn(block);
      EXPECT_EQ(counts.size(), static_cast<size_t>(std::min(trials, 12)));
      for (const auto& [condition, count] : counts) {
        EXPECT_GE(count, std::max(1, trials / 12));
        EXPECT_LE(count, (trials + 11) / 12);
      }
    }
  }
}

TEST(Practice, HasCatchTrialsInProportion) {
  const Protocol protocol = exampleProtocol(kYesNo + kBox + kPracticeFactors +
                                            "trials: {change: 3, catch: 1}\npractice: {trials: 8}\n");
  std::set<size_t> places;
  for (uint64_t seed = 0; seed < 100; ++seed) {
    const PlannedBlock block = makePracticeRound(protocol, 0, seed, 0);
    int catches = 0;
    for (size_t i = 0; i < block.trials.size(); ++i)
      if (!block.trials[i].change) ++catches, places.insert(i);
    EXPECT_EQ(catches, 2);
  }
  EXPECT_EQ(places.size(), 8U);
}

TEST(Practice, FurtherRoundsAreNewAndNumberedApart) {
  const std::string part = R"(    task: {type: interval, question: "Which?"}
    stimulus: {scene: {name: box}, levels: {before: 1, after: 0}}
    factors: {distance: [1, 2, 3, 4, 5, 6, 7, 8, 9, 10]}
    practice: {trials: 4, rounds: 3, correct: 2}
)";
  const Protocol protocol =
      exampleProtocol("part_order: shuffle\nparts:\n  - name: one\n" + part + "  - name: two\n" + part);
  const Design design = makeDesign(protocol, 5, 0);
  std::set<int> numbers;
  for (const PlannedBlock& block : design.blocks) {
    for (const PlannedTrial& trial : block.trials) EXPECT_TRUE(numbers.insert(trial.number).second);
    if (block.practice) {  // round 0 is the planned one
      const PlannedBlock again = makePracticeRound(protocol, block.part, 5, 0);
      for (size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(block.trials[i].condition, again.trials[i].condition);
        EXPECT_EQ(block.trials[i].target, again.trials[i].target);
      }
    }
  }
  EXPECT_EQ(numbers.size(), 28U);
  std::set<std::string> plans;
  for (int p = 0; p < 2; ++p)
    for (int round = 1; round < 3; ++round) {
      std::string plan;
      for (const PlannedTrial& trial : makePracticeRound(protocol, p, 5, round).trials) {
        EXPECT_TRUE(numbers.insert(trial.number).second);
        EXPECT_EQ(trial.repetition, round);
        plan += trial.condition.at("distance") + "/" + std::to_string(trial.target) + " ";
      }
      plans.insert(plan);
    }
  EXPECT_EQ(numbers.size(), 44U);
  EXPECT_EQ(*numbers.rbegin(), 43);
  EXPECT_EQ(plans.size(), 4U);
}

TEST(Practice, AdaptivePartsPractiseWithTheirOwnStimuli) {
  const Protocol protocol = exampleProtocol(kYesNo + R"(stimulus:
  scene: {name: box, distance: = distance}
  levels: {before: 1, after: 0}
procedure:
  type: staircase
  stimulus: {name: distance, start: 10, minimum: 1, maximum: 40}
  steps: 1
  stop: {trials: 20}
practice: {trials: 4, stimuli: [{distance: 2}, {distance: 3}]}
)");
  std::multiset<double> distances;
  for (const PlannedTrial& trial : makePracticeRound(protocol, 0, 1, 0).trials) {
    EXPECT_EQ(trial.procedure, -1);
    distances.insert(realOf(stimuliOf(protocol, trial)[0].scene.values, "distance"));
  }
  EXPECT_EQ(distances, (std::multiset<double>{2, 2, 3, 3}));
}

TEST(Practice, PairsAreDrawnToo) {
  const Protocol protocol = exampleProtocol(R"(task: {type: pairwise, question: "Better?"}
items: quality
factors: {quality: [1, 2, 5, 9]}
stimulus: {scene: {name: box}, before: {name: fast, quality: = quality}}
practice: {trials: 6}
)");
  const PlannedBlock block = makePracticeRound(protocol, 0, 1, 0);
  EXPECT_EQ(drawn(block).size(), 6U);  // each of the six pairs
  int second = 0;
  for (const PlannedTrial& trial : block.trials) second += trial.target;
  EXPECT_EQ(second, 3);
}

}  // namespace
}  // namespace limen::study
