// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/statistics/pairwise_scaling.h"
#include "analysis/statistics/summary.h"
#include "tests/analysis/statistics/expect.h"

namespace limen::analysis {
namespace {

// Data and expected values: reference/pairwise.R.
const std::vector<int64_t> kWins = {0, 14, 18, 25, 16, 0, 17, 21, 12, 13, 0, 19, 5, 9, 11, 0};

PairwiseOptions with(PairwiseModel model) {
  PairwiseOptions options;
  options.model = model;
  return options;
}

struct Expected {
  PairwiseModel model;
  std::vector<double> values, errors;
};

TEST(PairwiseScaling, ValuesAndErrorsAreThoseOfR) {
  const Expected cases[] = {
      {PairwiseModel::kBradleyTerry,
       {0.4302116603460151, 0.3223225873323650, -0.0295873925329082, -0.7229468551454719},
       {0.167818654134492, 0.165835461206057, 0.163478204117366, 0.177354189301483}},
      {PairwiseModel::kThurstoneMaximumLikelihood,
       {0.2687836181919200, 0.1974007745664857, -0.0194616966160196, -0.4467226961423861},
       {0.103286792917575, 0.101465708985869, 0.100718425734493, 0.106186087532723}},
      {PairwiseModel::kThurstoneLeastSquares,
       {0.2842792338325930, 0.1939865628508188, -0.0201365702090275, -0.4581292264743844},
       {0.106140604510874, 0.101024867246232, 0.100349232995351, 0.108018769811998}}};
  for (const Expected& c : cases) {
    const PairwiseScale s = scalePairs(kWins, 4, with(c.model));
    for (size_t i = 0; i < 4; ++i) {
      expectRelative(s.values[i], c.values[i], 1e-8);
      expectRelative(s.standardErrors[i], c.errors[i], 1e-5);  // the reference differentiates numerically
    }
    EXPECT_FALSE(s.penalised);
  }
}

TEST(PairwiseScaling, GoodnessOfFitIsThatOfR) {
  const PairwiseScale bt = scalePairs(kWins, 4, with(PairwiseModel::kBradleyTerry));
  EXPECT_EQ(bt.df, 3u);
  expectRelative(bt.deviance, 1.85451817478485, 1e-9);
  expectRelative(bt.pearson, 1.79091075628589, 1e-7);
  expectRelative(*bt.devianceP, 0.603143630862103, 1e-9);
  expectRelative(*bt.pearsonP, 0.616914851860327, 1e-7);
  const PairwiseScale t = scalePairs(kWins, 4, with(PairwiseModel::kThurstoneMaximumLikelihood));
  expectRelative(t.deviance, 1.79977186383728, 1e-9);
  expectRelative(t.pearson, 1.74302990606339, 1e-7);
}

TEST(PairwiseScaling, TwoItemsHaveTheClosedForm) {
  // 75 of 100: ln 3 apart, +-ln 3 / 2; the variance of a log odds is 1/75 + 1/25, of half of it a quarter.
  const PairwiseScale s = scalePairs({0, 75, 25, 0}, 2);
  EXPECT_NEAR(s.values[0], 0.5 * std::log(3.0), 1e-12);
  EXPECT_NEAR(s.standardErrors[0], 0.5 * std::sqrt(1.0 / 75.0 + 1.0 / 25.0), 1e-12);
  EXPECT_EQ(s.df, 0u);
  EXPECT_FALSE(s.devianceP);
  const PairwiseScale t = scalePairs({0, 75, 25, 0}, 2, with(PairwiseModel::kThurstoneMaximumLikelihood));
  EXPECT_NEAR(t.values[0] - t.values[1], 0.6744897501960817, 1e-12);
  EXPECT_NEAR(predictPreference(PairwiseModel::kThurstoneMaximumLikelihood, t.values[0] - t.values[1]), 0.75,
              1e-12);
}

TEST(PairwiseScaling, AMillionJudgementsOfAPairAndIncompleteDesignsWork) {
  const PairwiseScale s = scalePairs({0, 600000, 0, 400000, 0, 300000, 0, 700000, 0}, 3);
  EXPECT_NEAR(s.values[0] - s.values[1], std::log(1.5), 1e-10);
  EXPECT_NEAR(s.values[1] - s.values[2], std::log(3.0 / 7.0), 1e-10);
  EXPECT_EQ(s.pairsJudged, 2u);
}

TEST(PairwiseScaling, UnanimousItemsAreRefusedOrPenalisedAsR) {
  const std::vector<int64_t> wins = {0, 30, 30, 0, 0, 17, 0, 13, 0};
  expectError([&] { scalePairs(wins, 3); }, "no chain of preferences");
  expectError([&] { scalePairs(wins, 3, with(PairwiseModel::kThurstoneLeastSquares)); }, "items 0 and 1");
  PairwiseOptions options;
  options.unbounded = UnboundedScale::kPenalise;
  const PairwiseScale s = scalePairs(wins, 3, options);
  EXPECT_TRUE(s.penalised);
  EXPECT_NE(s.note.find("penalty"), std::string::npos);
  EXPECT_FALSE(s.devianceP);
  const double expected[] = {2.93348155041811, -1.33794021108383, -1.59554133933570};
  for (size_t i = 0; i < 3; ++i)
    expectRelative(s.values[i], expected[i], 1e-5);  // optim stops short of the optimum
  for (const PairwiseModel model :
       {PairwiseModel::kThurstoneLeastSquares, PairwiseModel::kThurstoneMaximumLikelihood}) {
    options.model = model;
    const PairwiseScale t = scalePairs(wins, 3, options);
    EXPECT_TRUE(t.penalised);
    for (const double value : t.values) EXPECT_LT(std::abs(value), 10.0);
  }
}

TEST(PairwiseScaling, BootstrapRepeatsBySeedAndAgreesWithTheHessian) {
  PairwiseOptions options;
  options.resamples = 2000;
  const PairwiseScale a = scalePairs(kWins, 4, options), b = scalePairs(kWins, 4, options);
  EXPECT_EQ(a.bootstrapValues, b.bootstrapValues);
  for (size_t i = 0; i < 4; ++i) {
    std::vector<double> drawn;
    for (const std::vector<double>& values : a.bootstrapValues) drawn.push_back(values[i]);
    // Binomial proportions of some 30 vary more than the model says they should by no more than their misfit.
    const double hessian = 2.0 * 1.959963984540054 * a.standardErrors[i];
    const double bootstrap = quantile(drawn, 0.975) - quantile(drawn, 0.025);
    EXPECT_NEAR(bootstrap / hessian, 1.0, 0.15);
  }
  // The values themselves: each sample's sum to 0, and all lie about the estimate.
  ASSERT_EQ(a.bootstrapValues.size(), 2000u);
  for (const std::vector<double>& values : a.bootstrapValues)
    EXPECT_NEAR(values[0] + values[1] + values[2] + values[3], 0.0, 1e-9);
  EXPECT_EQ(a.penalisedResamples, 0);
}

TEST(PairwiseScaling, DesignsThatCannotBeScaledAreRefused) {
  expectError([] { scalePairs({0, 3, 0, 0, 2, 0, 0, 0, 0, 0, 0, 5, 0, 0, 4, 0}, 4); }, "items 0 and 2");
  expectError([] { scalePairs({0, 3, -2, 0}, 2); }, "wins[1][0]");
  expectError([] { scalePairs({1, 3, 2, 0}, 2); }, "wins[0][0]");
  expectError([] { scalePairs({0, 3, 2}, 2); }, "wins[3]");
  expectError([] { scalePairs({0}, 1); }, "items");
}

TEST(PairwiseScaling, MessagesNameTheItems) {
  PairwiseOptions named;
  named.names = {"pcf", "hard", "pcss"};
  expectError([&] { scalePairs({0, 30, 30, 0, 0, 17, 0, 13, 0}, 3, named); }, "'hard'");
  named.model = PairwiseModel::kThurstoneLeastSquares;
  expectError([&] { scalePairs({0, 30, 30, 0, 0, 17, 0, 13, 0}, 3, named); }, "items 'pcf' and 'hard'");
  expectError(
      [&] {
        scalePairs({0, 3, 0, 2, 0, 0, 0, 0, 0}, 3, named);
      },
      "items 'pcf' and 'pcss' are not connected");
  expectError([&] { scalePairs({0, 3, 2, 0}, 2, named); }, "3 names for 2 items");
}

}  // namespace
}  // namespace limen::analysis
