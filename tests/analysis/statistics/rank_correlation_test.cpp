// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "analysis/statistics/rank_correlation.h"
#include "tests/analysis/statistics/expect.h"

namespace limen::analysis {
namespace {

// Data and expected values: reference/ranks.R.
const std::vector<double> kX = {1.2, 0.8, 2.5, 2.5, 3.1, 0.4, 1.9, 4.0, 2.5, 3.3, 0.4, 1.2};
const std::vector<double> kY = {0.25, 0.25, 0.5, 0.75, 1, 0, 0.5, 1, 0.75, 0.5, 0.25, 0};
const std::vector<double> kA = {3.1, 0.2, 5.9, 4.4, 1.3, 2.8, 7.7, 6.1};
const std::vector<double> kB = {2.2, 0.9, 4.1, 6.3, 0.5, 3.7, 5.2, 8.8};
constexpr double kZ = 1.959963984540054;

TEST(StuartTauC, PrintedValuesOfTheThesisAreFractionsOfItsCounts) {
  // Schwarz 2009, sections 10.4.1 and 10.4.2: n, m and P - Q that give each printed value.
  const struct {
    int64_t n, m, s;
    double printed;
  } cases[] = {{14, 8, 80, 0.933},   {14, 8, 62, 0.723},   {14, 11, 72, 0.808}, {14, 11, 50, 0.561},
               {28, 13, 286, 0.790}, {28, 13, 213, 0.589}, {8, 4, 20, 0.833},   {8, 4, 22, 0.917},
               {16, 5, 85, 0.830},   {8, 4, 18, 0.750},    {8, 4, 19, 0.792},   {16, 4, 72, 0.750},
               {8, 3, 20, 0.938},    {8, 3, 16, 0.750},    {16, 4, 75, 0.781},  {8, 3, 5, 0.234}};
  for (const auto& c : cases) EXPECT_NEAR(stuartTauC(c.n, c.m, c.s), c.printed, 5.001e-4) << c.s;
}

TEST(StuartTauC, CountsThatCannotBeAreRefused) {
  expectError([] { stuartTauC(1, 2, 0); }, "n");
  expectError([] { stuartTauC(8, 1, 0); }, "m");
  expectError([] { stuartTauC(8, 9, 0); }, "m");
  expectError([] { stuartTauC(8, 4, 29); }, "P - Q");
}

TEST(Kendall, TiedValuesAndErrorsAreThoseOfTheContingencyTable) {
  const Kendall k = kendall(kX, kY);
  EXPECT_EQ(k.concordant, 48);
  EXPECT_EQ(k.discordant, 5);
  EXPECT_EQ(k.distinctX, 8u);
  EXPECT_EQ(k.distinctY, 5u);
  EXPECT_EQ(k.tiedX, 5);  // 3 of 2.5, a pair of 1.2, a pair of 0.4
  EXPECT_EQ(k.tiedY, 9);  // 3 of 0.25, 3 of 0.5, pairs of 0.75, 1 and 0
  expectRelative(k.tauA.value, 0.651515151515151, 1e-12);
  expectRelative(*k.tauA.standardError, 0.130378285655236, 1e-12);
  expectRelative(k.tauB->value, 0.72923265858572262, 1e-12);
  expectRelative(*k.tauB->standardError, 0.103632595638238, 1e-12);
  expectRelative(k.tauC->value, 0.746527777777778, 1e-12);
  expectRelative(*k.tauC->standardError, 0.109342845067657, 1e-12);
  expectRelative(k.tauC->interval->low, 0.746527777777778 - kZ * 0.109342845067657, 1e-12);
  EXPECT_LE(k.tauC->interval->high, 1.0);
  EXPECT_FALSE(k.exact);
  expectRelative(k.p, 0.00220694872467456, 1e-9);
}

TEST(Kendall, WithoutTiesPIsExact) {
  const Kendall k = kendall(kA, kB);
  EXPECT_TRUE(k.exact);
  expectRelative(k.tauB->value, 0.6428571428571429, 1e-12);
  expectRelative(k.p, 0.0311507936507935, 1e-12);
  // Perfect order of n: 2 of n! arrangements.
  EXPECT_NEAR(kendall({1, 2, 3, 4, 5}, {1, 2, 3, 4, 5}).p, 2.0 / 120.0, 1e-15);
  EXPECT_EQ(kendall({1, 2}, {5, 3}).p, 1.0);
}

TEST(Kendall, CountsAreThoseOfAllPairsTakenOneByOne) {
  std::mt19937_64 random(3);
  std::vector<double> x, y;
  for (int i = 0; i < 300; ++i) {
    x.push_back(static_cast<double>(random() % 17));
    y.push_back(static_cast<double>(random() % 23) + 0.4 * x.back());
  }
  int64_t concordant = 0, discordant = 0;
  for (size_t i = 0; i < x.size(); ++i)
    for (size_t j = 0; j < i; ++j) {
      const double product = (x[i] - x[j]) * (y[i] - y[j]);
      concordant += product > 0.0 ? 1 : 0;
      discordant += product < 0.0 ? 1 : 0;
    }
  const Kendall k = kendall(x, y);
  EXPECT_EQ(k.concordant, concordant);
  EXPECT_EQ(k.discordant, discordant);
}

TEST(Kendall, AHundredThousandValuesAreCountedWithoutOverflow) {
  std::vector<double> x, y;
  constexpr int64_t kN = 200000;
  for (int64_t i = 0; i < kN; ++i) {
    x.push_back(static_cast<double>(i));
    y.push_back(static_cast<double>(-i));
  }
  const Kendall k = kendall(x, y);
  EXPECT_EQ(k.discordant, kN * (kN - 1) / 2);
  EXPECT_EQ(k.tauA.value, -1.0);
}

TEST(Kendall, AConstantListHasNoTauBAndNoTauC) {
  const Kendall k = kendall({1, 2, 3}, {1, 1, 1});
  EXPECT_FALSE(k.tauB || k.tauC);
  EXPECT_EQ(k.tauA.value, 0.0);
  EXPECT_EQ(k.p, 1.0);
}

TEST(Spearman, AreThoseOfR) {
  const Correlation exact = *spearman(kA, kB), ties = *spearman(kX, kY);
  EXPECT_TRUE(exact.exact);
  expectRelative(exact.coefficient.value, 0.8333333333333335, 1e-12);
  expectRelative(*exact.p, 0.0153769841269841, 1e-12);
  EXPECT_FALSE(ties.exact);
  expectRelative(ties.coefficient.value, 0.850484964784607667, 1e-12);
  expectRelative(*ties.p, 0.000455266634363363, 1e-9);
  const double r = 0.850484964784607667, error = std::sqrt((1.0 + r * r / 2.0) / 9.0);
  expectRelative(ties.coefficient.interval->low, std::tanh(std::atanh(r) - kZ * error), 1e-9);
}

TEST(Pearson, IsThatOfR) {
  const Correlation c = *pearson(kX, kY);
  expectRelative(c.coefficient.value, 0.865555612968779475, 1e-12);
  expectRelative(*c.p, 0.000274841352454156, 1e-9);
  expectRelative(c.coefficient.interval->low, 0.579533796489865138, 1e-9);
  expectRelative(c.coefficient.interval->high, 0.961725889747320761, 1e-9);
}

TEST(Pearson, EdgesAreBounded) {
  EXPECT_FALSE(pearson({1, 1, 1}, {1, 2, 3}));
  const Correlation line = *pearson({1, 2, 3, 4, 5}, {-2, -4, -6, -8, -10});
  EXPECT_NEAR(line.coefficient.value, -1.0, 1e-15);
  EXPECT_NEAR(*line.p, 0.0, 1e-20);
  EXPECT_FALSE(pearson({1, 2}, {1, 3})->p);
  EXPECT_FALSE(pearson({1, 2, 3}, {1, 3, 2})->coefficient.interval);
  // Scale does not matter, not even at the ends of what a double holds.
  const double r = pearson({1, 2, 4}, {3, 1, 5})->coefficient.value;
  expectRelative(pearson({1e308, -1e308, 1e308 / 3.0}, {1, 2, 3})->coefficient.value,
                 pearson({3, -3, 1}, {1, 2, 3})->coefficient.value, 1e-12);
  expectRelative(pearson({1e-300, 2e-300, 4e-300}, {3, 1, 5})->coefficient.value, r, 1e-12);
  expectRelative(pearson({1e9 + 1, 1e9 + 2, 1e9 + 4}, {3, 1, 5})->coefficient.value, r, 1e-12);
}

TEST(Pearson, MalformedListsAreRefusedByIndex) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expectError([=] { pearson({1, nan, 2}, {1, 2, 3}); }, "x[1]");
  expectError([=] { spearman({1, 2}, {1, 2, 3}); }, "y[2]");
  expectError([=] { kendall({1, 2, 3}, {1, 2}); }, "y[2]");
  expectError([=] { kendall({1}, {1}); }, "x");
}

TEST(ClampedPearson, LowersWhatLiesBeyondTheFirstCertainDetection) {
  // Rates 1 at predictions 3 and 8: R_c = 3. By hand: {1, 2, 3, 3} against {0, 1/2, 1, 1}, which lie on a
  // line.
  const ClampedPearson c = clampedPearson({1, 2, 3, 8}, {0.0, 0.5, 1.0, 1.0});
  EXPECT_EQ(*c.clamp, 3.0);
  EXPECT_EQ(c.clamped, 1u);
  EXPECT_NEAR(c.correlation->coefficient.value, 1.0, 1e-12);
  const ClampedPearson none = clampedPearson({1, 2, 3, 8}, {0.0, 0.5, 0.9, 0.95});
  EXPECT_FALSE(none.clamp);
  EXPECT_EQ(none.correlation->coefficient.value,
            pearson({1, 2, 3, 8}, {0.0, 0.5, 0.9, 0.95})->coefficient.value);
  expectError([] { clampedPearson({1, 2}, {50.0, 100.0}); }, "rates[0]");
}

}  // namespace
}  // namespace limen::analysis
