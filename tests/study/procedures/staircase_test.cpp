// SPDX-License-Identifier: BSD-3-Clause
#include "study/procedures/staircase.h"

#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "study/procedures/procedure.h"
#include "study/procedures/student_t.h"

namespace limen::study {
namespace {

using nlohmann::json;
using testing::DoubleEq;
using testing::ElementsAre;

// The stimuli that a procedure shows to these answers, and then the one that would follow (-1: none).
std::vector<double> shown(Procedure& procedure, const std::string& answers) {
  std::vector<double> out;
  for (char answer : answers) {
    const auto next = procedure.next();
    if (!next) break;
    out.push_back(next->front());
    procedure.update(*next, answer - '0');
  }
  out.push_back(procedure.next() ? procedure.next()->front() : -1);
  return out;
}

std::vector<double> reversals(const Procedure& procedure) {
  return procedure.state().at("reversals").get<std::vector<double>>();
}

json base() {
  return {{"type", "staircase"},
          {"stimulus", {{"name", "level"}, {"start", 10}}},
          {"steps", 2},
          {"stop", {{"trials", 100}}}};
}

TEST(Staircase, OneUpTwoDownFollowsItsRule) {
  json settings = base();
  settings["down"] = 2;
  const auto procedure = makeProcedure(readProcedure(settings, ""), 1);
  // Two positives go down; one negative goes up at once and starts the count anew. By hand:
  // 10 + | 10 + -> 8 | 8 - -> 10 reversal at 8 | 10 + | 10 - -> 12 (the first + is forgotten) | 12 + | 12 +
  // -> 10, reversal at 12 | 10 + | 10 + -> 8 | 8 - -> 10, reversal at 8
  EXPECT_THAT(shown(*procedure, "1101011110"), ElementsAre(10, 10, 8, 10, 10, 12, 12, 10, 10, 8, 10));
  EXPECT_THAT(reversals(*procedure), ElementsAre(8, 12, 8));
}

TEST(Staircase, StepsChangeAfterReversalsAndLimitsHold) {
  json settings = base();
  settings["steps"] = {4, 2, 1};
  settings["stimulus"]["minimum"] = 3;
  settings["stimulus"]["maximum"] = 12;
  const auto procedure = makeProcedure(readProcedure(settings, ""), 1);
  // 10 + -> 6 | 6 + -> 3 (limit) | 3 + -> 3 | 3 - -> reversal at 3, step 2: 5 | 5 - -> 7 | 7 + -> reversal at
  // 7, step 1: 6 | 6 - -> reversal at 6, step 1 (the last one stays): 7 | then 8, 9 ... up to 12 and no
  // further
  EXPECT_THAT(shown(*procedure, "111001000000000"),
              ElementsAre(10, 6, 3, 3, 5, 7, 6, 7, 8, 9, 10, 11, 12, 12, 12, 12));
  EXPECT_THAT(reversals(*procedure), ElementsAre(3, 7, 6));
}

TEST(Staircase, WeightedStepsGoUpFurther) {
  json settings = base();
  settings["steps"] = 1;
  settings["steps_up"] = 3;
  const auto procedure = makeProcedure(readProcedure(settings, ""), 1);
  EXPECT_THAT(shown(*procedure, "11010"), ElementsAre(10, 9, 8, 11, 10, 13));
  EXPECT_NEAR(procedure->estimate().parameters[1].mean, 0.75, 1e-12);
}

TEST(Staircase, RatiosMultiply) {
  json settings = base();
  settings["scale"] = "db";
  settings["steps"] = 20;
  settings["stimulus"]["start"] = 1;
  EXPECT_THAT(shown(*makeProcedure(readProcedure(settings, ""), 1), "1100"),
              ElementsAre(1, DoubleEq(0.1), DoubleEq(0.01), DoubleEq(0.1), DoubleEq(1)));
  settings["scale"] = "log10";
  settings["steps"] = 2;
  EXPECT_THAT(shown(*makeProcedure(readProcedure(settings, ""), 1), "10"),
              ElementsAre(1, DoubleEq(0.01), DoubleEq(1)));
  settings["harder"] = "higher";
  EXPECT_THAT(shown(*makeProcedure(readProcedure(settings, ""), 1), "10"),
              ElementsAre(1, DoubleEq(100), DoubleEq(1)));
}

TEST(Staircase, ALongRunOfOneAnswerStaysANumber) {
  json settings = base();
  settings["scale"] = "log10";
  settings["steps"] = 50;
  const auto procedure = makeProcedure(readProcedure(settings, ""), 1);
  for (int i = 0; i < 20; ++i) procedure->update(*procedure->next(), 1);
  EXPECT_EQ((*procedure->next())[0], 1e-300);
  for (int i = 0; i < 40; ++i) procedure->update(*procedure->next(), 0);
  EXPECT_EQ((*procedure->next())[0], 1e300);
}

TEST(Staircase, EndsAfterReversalsAndAveragesTheLast) {
  json settings = base();
  settings["stop"] = {{"reversals", 5}};
  settings["estimate_reversals"] = 4;
  const auto procedure = makeProcedure(readProcedure(settings, ""), 1);
  // 10 - 12 - 14 + | 12 - | 14 + | 12 + 10 - | 12 + end: reversals 14 12 14 10 12
  EXPECT_THAT(shown(*procedure, "0010110111"), ElementsAre(10, 12, 14, 12, 14, 12, 10, 12, -1));
  EXPECT_THAT(reversals(*procedure), ElementsAre(14, 12, 14, 10, 12));
  const Estimate estimate = procedure->estimate();
  EXPECT_EQ(estimate.kind, "mean of 4 reversals, approximate t interval of block means");
  EXPECT_NEAR(estimate.parameters[0].mean, 12, 1e-12);
  EXPECT_NEAR(estimate.parameters[0].median, 12, 1e-12);
  EXPECT_TRUE(std::isnan(estimate.parameters[0].low));  // too few reversals
}

TEST(Staircase, IntervalComesFromFourBlocksOfReversals) {
  // Blocks of two: means 11 13 12 14, mean 12.5, variance 5/3, standard error sqrt(5/12); t(3) = 3.1824463.
  const ReversalMean eight = meanOfReversals({12, 10, 14, 12, 13, 11, 15, 13}, 0.95);
  EXPECT_NEAR(eight.mean, 12.5, 1e-12);
  EXPECT_NEAR(eight.high - eight.mean, 3.1824463 * std::sqrt(5.0 / 12), 1e-6);
  // Blocks of four: means 12 13 11 13, squares sum to 2.75.
  const ReversalMean sixteen =
      meanOfReversals({12, 10, 14, 12, 13, 11, 15, 13, 12, 10, 12, 10, 14, 12, 14, 12}, 0.95);
  EXPECT_NEAR(sixteen.mean - sixteen.low, 3.1824463 * std::sqrt(2.75 / 12), 1e-6);
  // Ten: the last eight make the interval, around the mean of all.
  const ReversalMean ten = meanOfReversals({20, 18, 12, 10, 14, 12, 13, 11, 15, 13}, 0.95);
  EXPECT_NEAR(ten.mean, 13.8, 1e-12);
  EXPECT_NEAR(ten.high - ten.mean, 3.1824463 * std::sqrt(5.0 / 12), 1e-6);
}

TEST(Staircase, WithoutReversalsThereIsNoEstimate) {
  const auto procedure = makeProcedure(readProcedure(base(), ""), 1);
  EXPECT_TRUE(std::isnan(procedure->estimate().parameters[0].mean));
  EXPECT_TRUE(std::isnan(procedure->estimate().parameters[0].low));
}

TEST(Staircase, GoesOnFromTheStimulusThatWasShown) {
  const auto procedure = makeProcedure(readProcedure(base(), ""), 1);
  procedure->update({7.5}, 1);
  EXPECT_EQ(procedure->next(), std::vector<double>{5.5});
}

TEST(Staircase, TargetsTheProbabilitiesOfTheLiterature) {
  // Levitt (1971): one up, down after n: p^n = 1/2.
  for (int n = 1; n <= 4; ++n) EXPECT_NEAR(convergenceProbability(n, 1, 1, 1), std::pow(0.5, 1.0 / n), 1e-12);
  // Mirrored: 1 - (1 - p)^2 = 1/2.
  EXPECT_NEAR(convergenceProbability(1, 2, 1, 1), 1 - std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(convergenceProbability(2, 2, 1, 1), 0.5, 1e-12);
  // Kaernbach (1991): p stepDown = (1 - p) stepUp.
  EXPECT_NEAR(convergenceProbability(1, 1, 1, 3), 0.75, 1e-12);
  // Garcia-Perez (1998), table 1: one up, three down with a ratio of down to up steps of 0.7393 aims at 83.15
  // %.
  EXPECT_NEAR(convergenceProbability(3, 1, 0.7393, 1), 0.8315, 5e-5);
}

TEST(Staircase, StudentQuantilesAreTheTabulated) {
  // Abramowitz and Stegun, table 26.10.
  EXPECT_NEAR(studentQuantile(0.95, 1), 12.706, 5e-4);
  EXPECT_NEAR(studentQuantile(0.95, 2), 4.303, 5e-4);
  EXPECT_NEAR(studentQuantile(0.95, 3), 3.182, 5e-4);
  EXPECT_NEAR(studentQuantile(0.95, 7), 2.365, 5e-4);
  EXPECT_NEAR(studentQuantile(0.99, 10), 3.169, 5e-4);
  EXPECT_NEAR(studentQuantile(0.95, 120), 1.980, 5e-4);
}

}  // namespace
}  // namespace limen::study
