// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "analysis/statistics/rank_tests.h"
#include "tests/analysis/statistics/expect.h"

namespace limen::analysis {
namespace {

// Data and expected values: reference/ranks.R.
TEST(Friedman, IsThatOfRWithTies) {
  const FriedmanTest t = friedmanTest(
      {5, 3, 4, 1, 6, 2, 4, 4, 7, 5, 5, 2, 3, 3, 3, 1, 8, 4, 6, 5, 6, 6, 2, 3, 5, 1, 3, 3}, 7, 4);
  expectRelative(*t.chiSquared, 11.95161290322580605, 1e-12);
  expectRelative(*t.p, 0.00755076568476084, 1e-10);
  expectRelative(*t.kendallW, 0.56912442396313367, 1e-12);
  expectRelative(*t.f, 7.92513368983957101, 1e-12);
  expectRelative(*t.fP, 0.00141070221747404, 1e-10);
}

TEST(Friedman, ValuesThatRoundingTellsApartAreTies) {
  // 0.1 + 0.2 is above 0.3 in binary. Ranks 1.5, 1.5, 3 and 2, 1, 3.
  const FriedmanTest t = friedmanTest({0.1 + 0.2, 0.3, 0.7, 0.5, 0.4, 0.9}, 2, 3);
  EXPECT_EQ(t.meanRanks, (std::vector<double>{1.75, 1.25, 3.0}));
}

TEST(Friedman, PerfectAgreementAndNoneAreBounded) {
  const FriedmanTest same = friedmanTest({1, 2, 3, 4, 5, 6}, 2, 3);
  EXPECT_NEAR(*same.kendallW, 1.0, 1e-15);
  EXPECT_TRUE(std::isinf(*same.f));
  EXPECT_EQ(*same.fP, 0.0);
  const FriedmanTest tied = friedmanTest({1, 1, 2, 2}, 2, 2);
  EXPECT_FALSE(tied.chiSquared || tied.p || tied.kendallW);
  expectError([] { friedmanTest({1, 2, 3}, 2, 2); }, "values[3]");
  expectError([] { friedmanTest({1, 2}, 1, 2); }, "subjects");
}

TEST(SignedRank, AreThoseOfR) {
  const SignedRankTest exact =
      signedRankTest({3.1, 0.2, 5.9, 4.4, 1.3, 2.8, 7.7, 6.1}, {2.2, 0.9, 4.1, 6.3, 0.5, 1.7, 5.2, 3.0});
  EXPECT_TRUE(exact.exact);
  EXPECT_EQ(exact.positiveRanks, 29.0);
  expectRelative(exact.p, 0.1484375, 1e-12);
  const SignedRankTest ties =
      signedRankTest({4, 6, 7, 3, 9, 5, 8, 6, 7, 2, 5}, {3, 6, 5, 4, 6, 5, 4, 7, 4, 1, 2});
  EXPECT_FALSE(ties.exact);
  EXPECT_EQ(ties.zeros, 2u);
  EXPECT_EQ(ties.positiveRanks, 40.0);
  expectRelative(ties.p, 0.0414316183366989, 1e-10);
  EXPECT_NEAR(ties.rankBiserial, (40.0 - 5.0) / 45.0, 1e-15);
}

TEST(SignedRank, DifferencesThatRoundingTellsApartAreTies) {
  // 3.1 - 2.2 and 2.8 - 3.7; R's value is that of rounded differences.
  const SignedRankTest t =
      signedRankTest({3.1, 0.2, 5.9, 4.4, 1.3, 2.8, 7.7, 6.1}, {2.2, 0.9, 4.1, 6.3, 0.5, 3.7, 5.2, 8.8});
  EXPECT_FALSE(t.exact);
  EXPECT_EQ(t.positiveRanks, 17.5);
  EXPECT_EQ(t.p, 1.0);
  // 0.1 + 0.2 is not 0.3 in binary, but no difference either.
  EXPECT_EQ(signedRankTest({0.1 + 0.2, 5.0}, {0.3, 4.0}).zeros, 1u);
}

TEST(SignedRank, EdgesAreBounded) {
  EXPECT_EQ(signedRankTest({1, 2}, {1, 2}).p, 1.0);
  // All of n on one side: 2 of 2^n signs.
  EXPECT_NEAR(signedRankTest({1, 2, 3, 4, 5, 6}, {0, 0, 0, 0, 0, 0}).p, 2.0 / 64.0, 1e-15);
  expectError([] { signedRankTest({1, 2}, {1}); }, "second[1]");
  expectError([] { signedRankTest({}, {}); }, "first");
  expectError([] { signedRankTest({1.0}, {std::numeric_limits<double>::infinity()}); }, "second[0]");
}

}  // namespace
}  // namespace limen::analysis
