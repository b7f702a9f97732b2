// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/distributions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/analysis/statistics/expect.h"

namespace limen::analysis {
namespace {

constexpr double kTail = 1e-12;

// Expected values to 17 digits: reference/tails.py.
TEST(Distributions, NormalTailsKeepTheirDigitsFarOut) {
  expectRelative(normalUpper(1.0), 0.15865525393145705, kTail);
  expectRelative(normalUpper(5.0), 2.8665157187919391e-7, kTail);
  expectRelative(normalUpper(10.0), 7.6198530241605261e-24, kTail);
  expectRelative(normalLower(-20.0), 2.7536241186062337e-89, kTail);
  expectRelative(normalUpper(37.0), 5.7255712225245768e-300, kTail);
  expectRelative(normalTwoSided(-10.0), 2.0 * 7.6198530241605261e-24, kTail);
  expectRelative(logNormalLower(-50.0), -1254.8313611394199, kTail);
  expectRelative(logNormalLower(-300.0), -45006.622732118663, kTail);
  expectRelative(logNormalLower(-1e5), -5000000012.431864, kTail);
  expectRelative(logNormalLower(5.0), -2.8665161296376383e-7, 1e-9);  // -(q + q^2/2), q the upper tail
}

TEST(Distributions, NormalQuantilesReturnToTheTailTheyCameFrom) {
  for (const double p : {1e-300, 1e-30, 1e-9, 0.01, 0.3, 0.5, 0.8})
    expectRelative(normalLower(normalQuantile(p)), p, 1e-12);
  EXPECT_EQ(normalQuantile(0.0), -std::numeric_limits<double>::infinity());
}

TEST(Distributions, StudentTailsKeepTheirDigitsFarOut) {
  expectRelative(tTwoSided(0.001, 5.0), 0.99924078677219765, kTail);
  expectRelative(tTwoSided(10.0, 3.0), 0.0021283990584141501, kTail);
  expectRelative(tTwoSided(-50.0, 7.0), 3.3512525955500402e-10, kTail);
  expectRelative(tTwoSided(1e5, 2.0), 9.9999999985e-11, kTail);
  expectRelative(tTwoSided(10.0, 1000.0), 1.6670702958600066e-22, kTail);
  expectRelative(tTwoSided(12.5, 1e6), 7.5114116583558623e-36, kTail);
  EXPECT_EQ(tTwoSided(std::numeric_limits<double>::infinity(), 3.0), 0.0);
  for (const double p : {1e-12, 0.05, 0.7}) expectRelative(tTwoSided(tCritical(p, 6.0), 6.0), p, kTail);
}

TEST(Distributions, FTailsKeepTheirDigitsFarOut) {
  expectRelative(fUpper(0.001, 2.0, 9.0), 0.99900061081699498, kTail);
  expectRelative(fUpper(30.226, 6.0, 42.0), 9.786171050539716e-14, kTail);
  expectRelative(fUpper(1e4, 3.0, 20.0), 6.3720540858416611e-32, kTail);
  expectRelative(fUpper(1e8, 1.0, 7.0), 2.6410407775493194e-26, kTail);
  expectRelative(fUpper(5.0, 40.0, 400.0), 6.9248475422660746e-18, kTail);
}

TEST(Distributions, FValuesOfTheThesisHaveItsProbabilities) {
  // Recomputed probabilities of Schwarz 2009, sections 10.4.1 and 10.4.2.
  EXPECT_NEAR(fUpper(5.337, 1.0, 11.0), 0.0413, 5e-5);
  EXPECT_LT(fUpper(30.226, 6.0, 42.0), 1e-4);
  EXPECT_NEAR(fUpper(3.139, 6.0, 42.0), 0.01239, 5e-6);
  EXPECT_NEAR(fUpper(98.926, 1.0, 7.0), 2.2e-5, 5e-7);
  EXPECT_NEAR(fUpper(29.377, 1.0, 7.0), 0.00099, 5e-6);
}

TEST(Distributions, ChiSquaredTailsKeepTheirDigitsFarOut) {
  expectRelative(chiSquaredUpper(100.0, 1.0), 1.5239706048321052e-23, kTail);
  expectRelative(chiSquaredUpper(1000.0, 10.0), 1.8702907209159497e-208, kTail);
  expectRelative(chiSquaredUpper(3.0, 8.0), 0.93435754562154991, kTail);
  expectRelative(chiSquaredUpper(1400.0, 30.0), 7.8268663610386382e-276, kTail);
  expectRelative(chiSquaredUpper(1200.0, 700.0), 6.703680202694925e-29, kTail);
}

TEST(Distributions, NoncentralityOfFIsThatOfPublishedMeans) {
  // With one degree over very many, F is the square of a normal deviate: at F = z^2 the upper tail is 1/2 for
  // a mean of z, so the noncentrality is z^2, but for the far side, Phi(-2 z).
  EXPECT_NEAR(noncentralityOfF(25.0, 1.0, 1e7, 0.5), 25.0, 1e-3);
  // reference/anova.R, as shares of variance L / (L + 6 + 42 + 1).
  const auto share = [](double p) {
    const double noncentrality = noncentralityOfF(30.226, 6.0, 42.0, p);
    return noncentrality / (noncentrality + 49.0);
  };
  expectRelative(share(0.95), 0.682791560989442, 1e-9);
  expectRelative(share(0.05), 0.842294390643561, 1e-9);
  // 1 - P(F < x) already below what is asked for: no noncentrality can be that small.
  EXPECT_EQ(noncentralityOfF(0.1, 3.0, 20.0, 0.975), 0.0);
}

}  // namespace
}  // namespace limen::analysis
