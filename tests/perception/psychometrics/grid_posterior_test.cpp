// SPDX-License-Identifier: BSD-3-Clause
#include "perception/psychometrics/grid_posterior.h"

#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/base/error.h"

namespace limen::psychometrics {
namespace {

using nlohmann::json;
using testing::HasSubstr;

GridAxis unitAxis(size_t count) { return {"p", "", linearValues(0, 1, count)}; }

// ln likelihood of one toss of a coin that shows heads with probability p.
std::vector<double> toss(const GridPosterior& posterior, bool heads) {
  std::vector<double> out;
  for (size_t i = 0; i < posterior.size(); ++i) {
    const double p = posterior.grid().valueOf(i, 0);
    out.push_back(std::log(heads ? p : 1 - p));
  }
  return out;
}

// Uniform prior and k heads in n tosses: Beta(k + 1, n - k + 1), whose moments are known. On 2001 points sums
// are integrals but for O(1e-7).
TEST(GridPosterior, CoinTossesGiveTheBetaPosterior) {
  GridPosterior posterior({unitAxis(2001)}, {uniformPrior(unitAxis(2001))});
  for (int i = 0; i < 7; ++i) ASSERT_TRUE(posterior.update(toss(posterior, true).data()));
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(posterior.update(toss(posterior, false).data()));
  EXPECT_NEAR(posterior.mean(0), 8.0 / 12, 1e-6);
  EXPECT_NEAR(posterior.standardDeviation(0), std::sqrt(8.0 * 4 / (144 * 13)), 1e-6);
  EXPECT_NEAR(posterior.mode(0), 0.7, 1e-12);
  EXPECT_NEAR(posterior.grid().valueOf(posterior.modePoint(), 0), 0.7, 1e-12);
  // Quantiles of Beta(8, 4) by the binomial sum of 11 trials (Abramowitz and Stegun 26.5.24).
  const CredibleInterval interval = posterior.equalTailed(0, 0.95);
  const auto distribution = [](double x) {
    double sum = 0;
    for (int j = 8; j <= 11; ++j) {
      sum += std::tgamma(12) / (std::tgamma(j + 1) * std::tgamma(12 - j)) * std::pow(x, j) *
             std::pow(1 - x, 11 - j);
    }
    return sum;
  };
  EXPECT_NEAR(distribution(interval.low), 0.025, 1e-5);
  EXPECT_NEAR(distribution(interval.high), 0.975, 1e-5);
  EXPECT_NEAR(distribution(posterior.median(0)), 0.5, 1e-5);
  // Densities at both ends of the shortest interval are equal, and it holds 95 %.
  const CredibleInterval shortest = posterior.highestDensity(0, 0.95);
  const auto density = [](double x) { return std::pow(x, 7) * std::pow(1 - x, 3); };
  EXPECT_NEAR(density(shortest.low) / density(shortest.high), 1, 0.02);
  EXPECT_NEAR(distribution(shortest.high) - distribution(shortest.low), 0.95, 1e-4);
  EXPECT_LT(shortest.high - shortest.low, interval.high - interval.low);
}

TEST(GridPosterior, EntropyOfTheUniformIsTheLogarithmOfItsSize) {
  const GridAxis a = unitAxis(5), b = unitAxis(7);
  const GridPosterior posterior({a, b}, {uniformPrior(a), uniformPrior(b)});
  EXPECT_NEAR(posterior.entropy(), std::log(35.0), 1e-13);
  EXPECT_NEAR(posterior.median(0), 0.5, 1e-13);
  EXPECT_NEAR(posterior.mean(1), 0.5, 1e-13);
}

TEST(GridPosterior, MarginalsSumOverTheOtherDimensions) {
  const GridAxis a = {"a", "", {0, 1}}, b = {"b", "", {0, 1, 2}};
  GridPosterior posterior({a, b}, {{0.25, 0.75}, {0.2, 0.3, 0.5}});
  std::vector<double> likelihood = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6}, logs;
  for (double value : likelihood) logs.push_back(std::log(value));
  ASSERT_TRUE(posterior.update(logs.data()));
  // Products of prior and likelihood by hand: .005 .015 .0375 | .06 .1125 .225, sum .455.
  EXPECT_NEAR(posterior.marginal(0)[0], 0.0575 / 0.455, 1e-14);
  EXPECT_NEAR(posterior.marginal(1)[2], 0.2625 / 0.455, 1e-14);
  EXPECT_EQ(posterior.modePoint(), 5u);
}

TEST(GridPosterior, ThousandsOfAnswersDoNotUnderflow) {
  GridPosterior posterior({unitAxis(101)}, {uniformPrior(unitAxis(101))});
  for (int i = 0; i < 6000; ++i) ASSERT_TRUE(posterior.update(toss(posterior, i % 3 != 0).data()));
  EXPECT_NEAR(posterior.mean(0), 2.0 / 3, 0.01);
  // Then ten thousand of the other kind bring back what had become improbable: 4000 heads of 16000.
  for (int i = 0; i < 10000; ++i) ASSERT_TRUE(posterior.update(toss(posterior, false).data()));
  EXPECT_NEAR(posterior.mean(0), 0.25, 0.01);
}

TEST(GridPosterior, AnImpossibleAnswerLeavesItAsItWas) {
  const GridAxis axis = {"p", "", {0.0, 1.0}};
  GridPosterior posterior({axis}, {uniformPrior(axis)});
  ASSERT_TRUE(posterior.update(toss(posterior, true).data()));
  const std::string before = posterior.hash();
  EXPECT_FALSE(posterior.update(toss(posterior, false).data()));
  EXPECT_EQ(posterior.hash(), before);
}

TEST(GridPosterior, PriorsAreDensitiesNormalisedOverTheValues) {
  const GridAxis axis = {"x", "", {-1, 0, 1}};
  const std::vector<double> normal = readPrior({{"normal", {{"mean", 0}, {"sd", 1}}}}, axis, "prior");
  const double e = std::exp(-0.5);
  EXPECT_NEAR(normal[0], e / (1 + 2 * e), 1e-15);
  EXPECT_NEAR(normal[1], 1 / (1 + 2 * e), 1e-15);
  const GridAxis unit = {"x", "", {0, 0.5, 1}};
  EXPECT_NEAR(readPrior({{"beta", {{"a", 2}, {"b", 1}}}}, unit, "prior")[1], 0.5 / 1.5, 1e-15);
  EXPECT_NEAR(readPrior({1, 1, 2}, unit, "prior")[2], 0.5, 1e-15);
  EXPECT_NEAR(readPrior("uniform", unit, "prior")[0], 1.0 / 3, 1e-15);
}

std::string refusal(const json& prior) {
  try {
    readPrior(prior, {"x", "", {0, 0.5, 2}}, "slope.prior");
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(GridPosterior, BadPriorsAreRefused) {
  EXPECT_THAT(refusal({1, 2}), HasSubstr("2 weights for 3 values"));
  EXPECT_THAT(refusal({1, -2, 3}), HasSubstr("at least 0"));
  EXPECT_THAT(refusal({0, 0, 0}), HasSubstr("above 0"));
  EXPECT_THAT(refusal("flat"), HasSubstr("uniform"));
  EXPECT_THAT(refusal({{"normal", {{"mean", 0}, {"std", 1}}}}), HasSubstr("slope.prior.normal"));
  EXPECT_THAT(refusal({{"normal", {{"mean", 0}, {"sd", 0}}}}), HasSubstr("above 0"));
  EXPECT_THAT(refusal({{"beta", {{"a", 2}, {"b", 2}}}}), HasSubstr("from 0 to 1"));
}

TEST(GridPosterior, SingleValuesAreCertain) {
  const GridAxis fixed = {"lapse", "", {0.02}};
  const GridPosterior posterior({fixed}, {uniformPrior(fixed)});
  EXPECT_EQ(posterior.equalTailed(0, 0.95).low, 0.02);
  EXPECT_EQ(posterior.highestDensity(0, 0.95).high, 0.02);
  EXPECT_EQ(posterior.median(0), 0.02);
}

}  // namespace
}  // namespace limen::psychometrics
