// SPDX-License-Identifier: BSD-3-Clause
// Procedures are pure functions of settings, seed and answered trials.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <set>

#include "perception/psychometrics/random.h"
#include "study/procedures/procedure.h"
#include "tests/study/procedures/example_settings.h"

namespace limen::study {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::UnorderedElementsAre;

struct Session {
  std::vector<ProcedureTrial> trials;
  std::vector<std::string> states;  // after each trial
};

// Answers drawn apart from the procedure's own seed.
Session run(const ProcedureSettings& settings, uint64_t seed, int most) {
  Session out;
  const auto procedure = makeProcedure(settings, seed);
  while (static_cast<int>(out.trials.size()) < most) {
    const auto next = procedure->next();
    if (!next) break;
    psychometrics::Random random(psychometrics::childSeed(99, std::to_string(out.trials.size())));
    const int outcome = static_cast<int>(random.below(static_cast<uint64_t>(settings.outcomes)));
    procedure->update(*next, outcome);
    out.trials.push_back({*next, outcome});
    out.states.push_back(procedure->state().dump());
  }
  return out;
}

class EveryType : public testing::TestWithParam<json> {};

TEST_P(EveryType, ReplaysBitForBit) {
  const ProcedureSettings settings = readProcedure(GetParam(), "");
  const Session original = run(settings, 5, 60);
  ASSERT_FALSE(original.trials.empty());
  // The same settings read back from what was written, another object, stimuli not asked for in between.
  const auto again = makeProcedure(readProcedure(json::parse(toJson(settings).dump()), ""), 5);
  for (size_t i = 0; i < original.trials.size(); ++i) {
    if (i % 3 == 0) {
      EXPECT_EQ(again->next(), original.trials[i].stimulus) << "trial " << i + 1;
    }
    again->update(original.trials[i].stimulus, original.trials[i].outcome);
    ASSERT_EQ(again->state().dump(), original.states[i]) << "trial " << i + 1;
  }
  EXPECT_EQ(again->trialsDone(), static_cast<int>(original.trials.size()));
}

TEST_P(EveryType, NextStaysUntilTheAnswer) {
  const auto procedure = makeProcedure(readProcedure(GetParam(), ""), 8);
  const auto first = procedure->next();
  ASSERT_TRUE(first);
  const std::string state = procedure->state().dump();
  for (int i = 0; i < 3; ++i) EXPECT_EQ(procedure->next(), first);
  procedure->estimate();
  EXPECT_EQ(procedure->state().dump(), state);
}

TEST_P(EveryType, StimuliHaveTheDeclaredDimensionsAndLimits) {
  const ProcedureSettings settings = readProcedure(GetParam(), "");
  for (const ProcedureTrial& trial : run(settings, 3, 60).trials) {
    ASSERT_EQ(trial.stimulus.size(), settings.stimulus.size());
    for (size_t d = 0; d < trial.stimulus.size(); ++d) {
      EXPECT_GE(trial.stimulus[d], settings.stimulus[d].minimum);
      EXPECT_LE(trial.stimulus[d], settings.stimulus[d].maximum);
    }
  }
}

TEST_P(EveryType, EndsAfterItsMostTrials) {
  const ProcedureSettings settings = readProcedure(GetParam(), "");
  ASSERT_TRUE(settings.mostTrials);
  EXPECT_LE(static_cast<int>(run(settings, 4, 10'000).trials.size()), *settings.mostTrials);
}

INSTANTIATE_TEST_SUITE_P(Procedures, EveryType, testing::ValuesIn(exampleSettings()),
                         [](const testing::TestParamInfo<json>& example) {
                           return example.param["type"].get<std::string>() + std::to_string(example.index);
                         });

TEST(Constant, ShowsEveryStimulusOnceABlockInAnotherOrder) {
  const json settings = {{"type", "constant"}, {"stimulus", {1, 2, 3, 4, 5, 6, 7, 8}}, {"repetitions", 20}};
  const Session one = run(readProcedure(settings, ""), 1, 1000);
  ASSERT_EQ(one.trials.size(), 160u);
  std::set<std::vector<double>> orders;
  for (size_t block = 0; block < 20; ++block) {
    std::vector<double> order;
    for (size_t i = 0; i < 8; ++i) order.push_back(one.trials[8 * block + i].stimulus[0]);
    orders.insert(order);
    EXPECT_THAT(order, UnorderedElementsAre(1, 2, 3, 4, 5, 6, 7, 8));
  }
  EXPECT_EQ(orders.size(), 20u);  // of 40,320 orders: twice the same has a probability of 0.5 %
  const Session other = run(readProcedure(settings, ""), 2, 8);
  EXPECT_NE(
      one.trials[0].stimulus[0] * 100 + one.trials[1].stimulus[0] * 10 + one.trials[2].stimulus[0],
      other.trials[0].stimulus[0] * 100 + other.trials[1].stimulus[0] * 10 + other.trials[2].stimulus[0]);
}

TEST(Constant, ProportionsHaveWilsonsInterval) {
  const auto procedure = makeProcedure(
      readProcedure(
          {{"type", "constant"}, {"stimulus", {{"name", "x"}, {"values", {1}}}}, {"repetitions", 10}}, ""),
      1);
  for (int i = 0; i < 10; ++i) procedure->update({1}, i < 8 ? 1 : 0);
  // Eight of ten: 0.490162 to 0.943318 (Newcombe 1998's method 3 for these counts; by the formula with z
  // = 1.959964: centre (0.8 + 0.192073) / 1.384146 = 0.716740, half width 0.226578).
  const ParameterEstimate p = procedure->estimate().parameters.front();
  EXPECT_EQ(p.name, "P(1 | x=1)");
  EXPECT_NEAR(p.mean, 0.8, 1e-12);
  EXPECT_NEAR(p.low, 0.490162, 1e-5);
  EXPECT_NEAR(p.high, 0.943318, 1e-5);
}

json twoConstants(const std::string& order) {
  return {{"type", "interleaved"},
          {"order", order},
          {"procedures",
           {{{"type", "constant"},
             {"name", "a"},
             {"stimulus", {{"name", "x"}, {"values", {1, 2}}}},
             {"repetitions", 1},
             {"order", "listed"}},
            {{"type", "constant"},
             {"name", "b"},
             {"stimulus", {{"name", "x"}, {"values", {10, 20, 30}}}},
             {"repetitions", 1},
             {"order", "listed"}}}}};
}

TEST(Interleaved, RotationGoesRoundAndSkipsTheFinished) {
  std::vector<std::vector<double>> shown;
  for (const ProcedureTrial& trial : run(readProcedure(twoConstants("rotation"), ""), 1, 100).trials) {
    shown.push_back(trial.stimulus);
  }
  using Answers = std::vector<double>;
  EXPECT_THAT(shown,
              ElementsAre(Answers{0, 1}, Answers{1, 10}, Answers{0, 2}, Answers{1, 20}, Answers{1, 30}));
}

TEST(Interleaved, RandomOrderIsEvenAndEachGetsItsOwnTrials) {
  const ProcedureSettings settings = readProcedure(twoConstants("random"), "");
  int first = 0;
  for (uint64_t seed = 0; seed < 400; ++seed) {
    const Session one = run(settings, seed, 100);
    ASSERT_EQ(one.trials.size(), 5u);
    first += one.trials[0].stimulus[0] == 0 ? 1 : 0;
  }
  EXPECT_NEAR(first, 200, 5 * 10);
  const auto procedure = makeProcedure(settings, 1);
  procedure->update({1, 10}, 1);
  EXPECT_EQ(procedure->estimate().parameters.at(0).name, "b.P(1 | x=10)");
}

}  // namespace
}  // namespace limen::study
