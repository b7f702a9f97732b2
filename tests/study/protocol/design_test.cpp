// SPDX-License-Identifier: BSD-3-Clause
#include "study/protocol/design.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/study/protocol/example.h"

namespace limen::study {
namespace {

const std::string kFactors = R"(factors:
  distance: [4, 6, 9]
  kind: [wood, stone]
  presentation: [dynamic, static]
)";

std::vector<PlannedTrial> trialsOf(const Design& design) {
  std::vector<PlannedTrial> out;
  for (const PlannedBlock& block : design.blocks)
    if (!block.practice) out.insert(out.end(), block.trials.begin(), block.trials.end());
  return out;
}

/// All that a plan says, as text.
std::string textOf(const Design& design) {
  nlohmann::json out = nlohmann::json::array();
  for (const PlannedBlock& block : design.blocks)
    for (const PlannedTrial& trial : block.trials)
      out.push_back({block.name, trial.number, trial.part, trial.block, trial.practice, trial.condition,
                     trial.variables, trial.change, trial.repetition, trial.target, trial.procedure});
  for (const PlannedProcedure& procedure : design.procedures)
    out.push_back({procedure.part, procedure.condition, procedure.settings, procedure.seed});
  return out.dump();
}

template <class Value>
int longestRun(const std::vector<PlannedTrial>& trials, Value value) {
  int longest = 0, run = 0;
  for (size_t i = 0; i < trials.size(); ++i) {
    run = i > 0 && value(trials[i]) == value(trials[i - 1]) ? run + 1 : 1;
    longest = std::max(longest, run);
  }
  return longest;
}

TEST(Design, ShowsEveryConditionAsOftenAsTheProtocolSays) {
  const Protocol protocol = exampleProtocol(kYesNo + kBox + kFactors + "trials: {change: 3, catch: 2}\n");
  const Design design = makeDesign(protocol, 1, 0);
  ASSERT_EQ(design.blocks.size(), 1U);
  std::map<std::pair<std::map<std::string, std::string>, bool>, std::multiset<int>> counts;
  std::set<int> numbers;
  for (const PlannedTrial& trial : trialsOf(design)) {
    counts[{trial.condition, trial.change}].insert(trial.repetition);
    numbers.insert(trial.number);
    EXPECT_EQ(trial.variables.at("kind"), trial.condition.at("kind"));
    EXPECT_EQ(trial.variables.at("distance").dump(), trial.condition.at("distance"));
  }
  EXPECT_EQ(counts.size(), 24U);  // 3 x 2 x 2 conditions with and without change
  for (const auto& [key, repetitions] : counts)
    EXPECT_EQ(repetitions, key.second ? (std::multiset<int>{0, 1, 2}) : (std::multiset<int>{0, 1}));
  EXPECT_EQ(numbers.size(), 60U);
  EXPECT_EQ(*numbers.begin(), 0);
  EXPECT_EQ(*numbers.rbegin(), 59);
}

TEST(Design, IsAFunctionOfItsArguments) {
  const std::string part =
      kYesNo + kBox + kFactors + "trials: {change: 2, catch: 1}\npractice: {trials: 4}\n";
  const Protocol protocol = exampleProtocol(part);
  EXPECT_EQ(textOf(makeDesign(protocol, 7, 3)), textOf(makeDesign(exampleProtocol(part), 7, 3)));
  std::set<std::string> plans;
  for (uint64_t seed = 0; seed < 50; ++seed) plans.insert(textOf(makeDesign(protocol, seed, 0)));
  EXPECT_EQ(plans.size(), 50U);
  // Nothing here is balanced over participants.
  EXPECT_EQ(textOf(makeDesign(protocol, 7, 3)), textOf(makeDesign(protocol, 7, 4)));
}

TEST(Design, KeepsBlocksApartAndInOrder) {
  const Protocol protocol =
      exampleProtocol(kYesNo + kBox + kFactors +
                      "blocks: {by: presentation, order: [static, dynamic]}\ntrials: {change: 2}\n");
  for (uint64_t seed = 0; seed < 5; ++seed) {
    const Design design = makeDesign(protocol, seed, 0);
    ASSERT_EQ(design.blocks.size(), 2U);
    EXPECT_EQ(design.blocks[0].name, "main: static");
    EXPECT_EQ(design.blocks[1].name, "main: dynamic");
    for (size_t b = 0; b < 2; ++b) {
      EXPECT_EQ(design.blocks[b].trials.size(), 12U);
      for (const PlannedTrial& trial : design.blocks[b].trials) {
        EXPECT_EQ(trial.condition.at("presentation"), b == 0 ? "static" : "dynamic");
        EXPECT_EQ(trial.block, static_cast<int>(b));
      }
    }
  }
}

TEST(Design, LimitsRuns) {
  const Protocol protocol = exampleProtocol(kYesNo + kBox + kFactors +
                                            "trials: {change: 2, catch: 1}\norder: {kind: shuffle, "
                                            "at_most_in_a_row: {change: 3, kind: 1, distance: 2}}\n");
  for (uint64_t seed = 0; seed < 30; ++seed) {
    const std::vector<PlannedTrial> trials = trialsOf(makeDesign(protocol, seed, 0));
    EXPECT_EQ(trials.size(), 36U);
    EXPECT_LE(longestRun(trials, [](const PlannedTrial& t) { return t.change; }), 3);
    EXPECT_EQ(longestRun(trials, [](const PlannedTrial& t) { return t.condition.at("kind"); }), 1);
    EXPECT_LE(longestRun(trials, [](const PlannedTrial& t) { return t.condition.at("distance"); }), 2);
  }
}

TEST(Design, BalancesTargets) {
  const Protocol protocol = exampleProtocol(
      R"(task: {type: alternative, alternatives: 3, question: "Which?"}
)" + kBox +
      "factors: {distance: [1, 2, 3, 4]}\ntrials: {change: 7}\n");
  std::map<std::string, int> differing;
  for (uint64_t seed = 0; seed < 20; ++seed) {
    std::map<std::string, std::map<int, int>> counts;
    std::map<int, int> all;
    for (const PlannedTrial& trial : trialsOf(makeDesign(protocol, seed, 0))) {
      ++counts[trial.condition.at("distance")][trial.target];
      ++all[trial.target];
    }
    // 7 = 2 + 2 + 3 in a condition, 28 = 9 + 9 + 10 in all.
    for (const auto& [distance, targets] : counts)
      for (int target = 0; target < 3; ++target) {
        EXPECT_GE(targets.at(target), 2);
        EXPECT_LE(targets.at(target), 3);
      }
    for (int target = 0; target < 3; ++target) {
      EXPECT_GE(all[target], 9);
      EXPECT_LE(all[target], 10);
    }
  }
}

TEST(Design, ComparesEveryPairInBothOrders) {
  const Protocol protocol = exampleProtocol(R"(task: {type: pairwise, question: "Better?"}
items: quality
factors: {quality: [1, 2, 5, 9], distance: [3, 4]}
stimulus:
  scene: {name: box, distance: = distance}
  before: {name: fast, quality: = quality}
  presentation: static
trials: {change: 2}
)");
  std::map<std::vector<std::string>, int> counts;
  for (const PlannedTrial& trial : trialsOf(makeDesign(protocol, 3, 0))) {
    const std::string &a = trial.condition.at("item_a"), &b = trial.condition.at("item_b");
    ++counts[{trial.condition.at("distance"), trial.target == 0 ? b : a, trial.target == 0 ? a : b}];
  }
  EXPECT_EQ(counts.size(), 2U * 4U * 3U);  // ordered pairs in each condition
  for (const auto& [shown, count] : counts) EXPECT_EQ(count, 2);
}

const std::string kAdaptive = R"(factors: {kind: [wood, stone], presentation: [dynamic, static]}
procedure:
  type: staircase
  stimulus: {name: distance, start: 10, minimum: 1, maximum: 40}
  down: 2
  steps: [4, 2, 1]
  harder: higher
  stop: {trials: 20}
)";

TEST(Design, MixesProceduresAndSpreadsCatchTrials) {
  const Protocol protocol = exampleProtocol(kYesNo + kBox + kAdaptive + "trials: {catch: 10}\n");
  std::set<size_t> places;
  std::set<uint64_t> seeds;
  for (uint64_t seed = 0; seed < 200; ++seed) {
    const Design design = makeDesign(protocol, seed, 0);
    ASSERT_EQ(design.procedures.size(), 4U);
    for (const PlannedProcedure& procedure : design.procedures) seeds.insert(procedure.seed);
    const std::vector<PlannedTrial> trials = trialsOf(design);
    ASSERT_EQ(trials.size(), 90U);
    std::map<int, int> changes, catches;
    for (size_t i = 0; i < trials.size(); ++i) {
      ++(trials[i].change ? changes : catches)[trials[i].procedure];
      EXPECT_EQ(trials[i].condition, design.procedures[static_cast<size_t>(trials[i].procedure)].condition);
      if (!trials[i].change) places.insert(i);
    }
    for (int p = 0; p < 4; ++p) {
      EXPECT_EQ(changes[p], 20);
      EXPECT_GE(catches[p], 2);
      EXPECT_LE(catches[p], 3);
    }
    // One in each stretch of nine trials.
    for (size_t stretch = 0; stretch < 10; ++stretch)
      EXPECT_EQ(std::count_if(trials.begin() + static_cast<long>(9 * stretch),
                              trials.begin() + static_cast<long>(9 * stretch + 9),
                              [](const PlannedTrial& trial) { return !trial.change; }),
                1);
  }
  EXPECT_EQ(places.size(), 90U);  // anywhere: not to be foreseen
  EXPECT_EQ(seeds.size(), 800U);
}

TEST(Design, LimitsRunsOfAdaptiveTrialsToo) {
  const Protocol protocol = exampleProtocol(kYesNo + kBox + kAdaptive +
                                            "trials: {catch: 12}\norder: {at_most_in_a_row: {kind: 2}}\n");
  for (uint64_t seed = 0; seed < 10; ++seed)
    EXPECT_LE(longestRun(trialsOf(makeDesign(protocol, seed, 0)),
                         [](const PlannedTrial& t) { return t.condition.at("kind"); }),
              2);
}

TEST(Design, CrossesOrdersOfPartsAndBlocks) {
  const std::string part = R"(    task: {type: yes_no, question: "Seen?"}
    stimulus: {scene: {name: box}, levels: {before: 1, after: 0}}
    factors: {kind: [a, b, c]}
    blocks: {by: kind, order: latin}
)";
  const Protocol protocol =
      exampleProtocol("part_order: latin\nparts:\n  - name: one\n" + part + "  - name: two\n" + part);
  // 2 orders of the parts x 3 x 3 of their blocks: all different over 18 participants, then again.
  std::set<std::string> orders;
  std::map<std::string, int> first;
  const auto orderOf = [&](int participant) {
    std::string out;
    for (const PlannedBlock& block : makeDesign(protocol, 1, participant).blocks) out += block.name + "; ";
    return out;
  };
  for (int participant = 0; participant < 18; ++participant) {
    orders.insert(orderOf(participant));
    ++first[orderOf(participant).substr(0, 6)];
  }
  EXPECT_EQ(orders.size(), 18U);
  for (const auto& [name, count] : first) EXPECT_EQ(count, 3) << name;
  EXPECT_EQ(orderOf(18), orderOf(0));
}

TEST(Design, SidesOfAnswersAlternateAndAreCrossedWithLatinOrders) {
  // Six rows, an even number: sides by the parity of the participant would always go with the same rows.
  for (const std::string levels : {"[a, b, c, d, e, f]", "[a, b, c]", "[a]"}) {
    const Protocol protocol = exampleProtocol(kYesNo + kBox + "factors: {kind: " + levels +
                                              "}\nblocks: {by: kind, order: latin}\n");
    const int rows = static_cast<int>(protocol.parts[0].blockLevels.size());
    std::set<std::pair<std::string, bool>> combinations;
    int mirrored = 0;
    for (int participant = 0; participant < 2 * rows; ++participant) {
      const Design design = makeDesign(protocol, 1, participant);
      combinations.emplace(design.blocks[0].name, design.answersMirrored);
      mirrored += design.answersMirrored ? 1 : 0;
      if (participant < rows) {
        EXPECT_EQ(design.answersMirrored, participant % 2 == 1) << levels;
      }
    }
    EXPECT_EQ(mirrored, rows) << levels;
    EXPECT_EQ(combinations.size(), static_cast<size_t>(2 * rows)) << levels;
  }
}

TEST(Design, SidesOfAnswersAreAsTheProtocolDeclares) {
  const auto left = [](const std::string& setting, int participant) {
    const Protocol protocol =
        exampleProtocol("task: {type: yes_no, question: \"Seen?\"" + setting + "}\n" + kBox);
    return answersShown(protocol.parts[0].task, makeDesign(protocol, 1, participant).answersMirrored).front();
  };
  EXPECT_EQ(left("", 0), 0U);
  EXPECT_EQ(left("", 1), 1U) << "counterbalanced is the default";
  for (int participant = 0; participant < 2; ++participant) {
    EXPECT_EQ(left(", answer_sides: as_written", participant), 0U);
    EXPECT_EQ(left(", answer_sides: reversed", participant), 1U);
  }
  // Left and right, first and second stay where they belong.
  const Protocol places = exampleProtocol("task: {type: alternative, question: \"Where?\"}\n" + kBox);
  EXPECT_EQ(answersShown(places.parts[0].task, true), (std::vector<size_t>{0, 1}));
}

TEST(Design, WilliamsOrderOfTrials) {
  const Protocol protocol =
      exampleProtocol(kYesNo + kBox + "factors: {distance: [1, 2, 3, 4]}\norder: williams\n");
  std::map<std::pair<std::string, std::string>, int> follows;
  for (int participant = 0; participant < 4; ++participant) {
    const std::vector<PlannedTrial> trials = trialsOf(makeDesign(protocol, 1, participant));
    for (size_t i = 1; i < trials.size(); ++i)
      ++follows[{trials[i - 1].condition.at("distance"), trials[i].condition.at("distance")}];
  }
  EXPECT_EQ(follows.size(), 12U);
  for (const auto& [pair, count] : follows) EXPECT_EQ(count, 1);
}

TEST(Design, FixedOrderIsThatOfWriting) {
  const Protocol protocol = exampleProtocol(kYesNo + kBox + kFactors + "order: fixed\n");
  std::string distances;
  for (const PlannedTrial& trial : trialsOf(makeDesign(protocol, 9, 9)))
    distances += trial.condition.at("distance");
  EXPECT_EQ(distances, "444466669999");
}

}  // namespace
}  // namespace limen::study
