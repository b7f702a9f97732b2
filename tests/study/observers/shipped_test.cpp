// SPDX-License-Identifier: BSD-3-Clause
// What simulated participants leave in the store for the protocols that come with Limen, counted there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>

#include "experiments/store/sessions.h"
#include "renderer/catalogue.h"
#include "study/observers/simulate.h"
#include "tests/study/observers/binomial.h"
#include "tests/study/observers/example.h"

namespace limen::study {
namespace {

using store::StudyTrial;

struct Sitting {
  store::StudySession session;
  std::vector<StudyTrial> trials;  // those that count, without practice, in order of showing
};

std::vector<Sitting> simulate(const std::string& name, int observers) {
  const Protocol protocol = readProtocol(name, catalogueFromRegistries());
  TemporaryStore store;
  SimulationRequest request;
  request.store = store.path;
  request.observers = observers;
  request.observer = chooseObserver("lapsing");
  request.display = perception::readDisplay(protocol.display);
  simulateSessions(protocol, request);
  const store::SessionReader reader(store.path);
  std::vector<Sitting> out;
  for (const store::StudySession& session : reader.sessions()) {
    Sitting sitting{session, {}};
    for (StudyTrial& trial : reader.trials(session.id))
      if (!trial.practice && trial.counts()) sitting.trials.push_back(std::move(trial));
    std::sort(sitting.trials.begin(), sitting.trials.end(),
              [](const StudyTrial& a, const StudyTrial& b) { return a.event < b.event; });
    out.push_back(std::move(sitting));
  }
  return out;
}

std::string level(const StudyTrial& trial, const char* factor) {
  return trial.condition.at(factor).get<std::string>();
}

// Trials of each condition with and without a change.
std::map<std::string, std::pair<int, int>> countsOf(const std::vector<StudyTrial>& trials) {
  std::map<std::string, std::pair<int, int>> out;
  for (const StudyTrial& trial : trials) {
    auto& count = out[trial.part + trial.condition.dump()];
    ++(trial.change ? count.first : count.second);
  }
  return out;
}

// "Yes" without a change against the observers' own rates, whose sum has a variance of at most its mean.
void expectCatchRate(const std::vector<Sitting>& sittings) {
  double expected = 0.0;
  int yes = 0;
  for (const Sitting& sitting : sittings)
    for (const StudyTrial& trial : sitting.trials) {
      if (trial.change) continue;
      expected += trial.response->extra.at("probability").get<double>();
      yes += trial.response->answer == "yes";
    }
  EXPECT_NEAR(yes, expected, 5.0 * std::sqrt(expected));
  EXPECT_GT(yes, 0);
}

TEST(ShippedProtocols, FirstExperimentHas112TrialsBalancedOverItsFactors) {
  const std::vector<Sitting> sittings = simulate("experiment_1", 24);
  ASSERT_EQ(sittings.size(), 24u);
  std::set<std::string> orders;
  for (const Sitting& sitting : sittings) {
    EXPECT_EQ(sitting.session.state, "finished");
    ASSERT_EQ(sitting.trials.size(), 112u);
    const auto counts = countsOf(sitting.trials);
    EXPECT_EQ(counts.size(), 28u);
    for (const auto& [condition, count] : counts) EXPECT_EQ(count, std::make_pair(3, 1)) << condition;
    // All dynamic ones before all static ones, as in the thesis.
    for (size_t i = 0; i < 112; ++i)
      EXPECT_EQ(level(sitting.trials[i], "presentation"), i < 56 ? "dynamic" : "static");
    std::string order;
    for (const StudyTrial& trial : sitting.trials)
      order += trial.condition.dump() + (trial.change ? "+" : "-");
    orders.insert(order);
  }
  EXPECT_EQ(orders.size(), 24u);
  expectCatchRate(sittings);
}

TEST(ShippedProtocols, SecondExperimentHas64TrialsAndItsPartsTakeTurns) {
  const std::vector<Sitting> sittings = simulate("experiment_2", 24);
  ASSERT_EQ(sittings.size(), 24u);
  int objectFirst = 0;
  std::map<std::string, std::pair<int, int>> catches;  // "yes" and all
  for (const Sitting& sitting : sittings) {
    ASSERT_EQ(sitting.trials.size(), 64u);
    const auto counts = countsOf(sitting.trials);
    EXPECT_EQ(counts.size(), 32u);
    for (const auto& [condition, count] : counts) EXPECT_EQ(count, std::make_pair(1, 1)) << condition;
    // One part is over before the other begins.
    for (size_t i = 1; i < 64; ++i)
      if (i != 32) {
        EXPECT_EQ(sitting.trials[i].part, sitting.trials[i - 1].part);
      }
    EXPECT_NE(sitting.trials[31].part, sitting.trials[32].part);
    objectFirst += sitting.trials[0].part == "object";
    for (const StudyTrial& trial : sitting.trials) {
      const bool yes = trial.response->answer == "yes";
      EXPECT_EQ(trial.response->severity.has_value(), yes);
      if (trial.change) continue;
      catches[trial.part].first += yes;
      ++catches[trial.part].second;
    }
  }
  EXPECT_EQ(objectFirst, 12);
  // The rates that the block declares, the same for all observers.
  EXPECT_TRUE(isRate(catches["object"].first, catches["object"].second, 0.042));
  EXPECT_TRUE(isRate(catches["terrain"].first, catches["terrain"].second, 0.031));
}

TEST(ShippedProtocols, ThresholdsAskForBothOrdersOfIntervals) {
  const std::vector<Sitting> sittings = simulate("threshold_2ifc", 4);
  for (const Sitting& sitting : sittings) {
    std::map<std::string, int> counts;
    int second = 0;
    for (const StudyTrial& trial : sitting.trials) {
      ++counts[trial.condition.dump()];
      second += trial.target;
      EXPECT_EQ(trial.stimuli.size(), 2u);
      EXPECT_EQ(trial.procedureStimulus.size(), 1u);
    }
    EXPECT_EQ(counts.size(), 4u);
    for (const auto& [condition, count] : counts) EXPECT_EQ(count, 40) << condition;
    EXPECT_GE(second, 40);
    EXPECT_LE(second, 120);
  }
}

TEST(ShippedProtocols, PairsAreComparedOnceOnEitherSide) {
  const std::vector<Sitting> sittings = simulate("quality_pairs", 3);
  for (const Sitting& sitting : sittings) {
    // 7 settings, 21 pairs, on either side, in two scenes.
    ASSERT_EQ(sitting.trials.size(), 84u);
    std::set<std::string> seen;
    for (const StudyTrial& trial : sitting.trials) {
      std::string left = level(trial, "item_a"), right = level(trial, "item_b");
      EXPECT_NE(left, right);
      if (trial.target == 0) std::swap(left, right);
      seen.insert(left + " " + right + " " + level(trial, "scene"));
    }
    EXPECT_EQ(seen.size(), 84u);
  }
}

}  // namespace
}  // namespace limen::study
