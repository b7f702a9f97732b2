// SPDX-License-Identifier: BSD-3-Clause
#include "perception/psychometrics/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "experiments/base/hash.h"

namespace limen::psychometrics {
namespace {

// xoshiro256** from the state that SplitMix64 makes of seed 0. Its first outputs for that seed are published
// with SplitMix64's reference: e220a8397b1dcdaf 6e789e6aa1b965f4 06c45d188009454f f88bb8a8724c81ec. With
// those as the state, the first number by hand is rotl(s1 * 5, 7) * 9.
TEST(Random, FirstNumberFollowsFromThePublishedState) {
  const uint64_t s1 = 0x6e789e6aa1b965f4u;
  const uint64_t product = s1 * 5;
  EXPECT_EQ(Random(0).bits(), ((product << 7) | (product >> 57)) * 9);
}

TEST(Random, ChildSeedsDependOnSeedAndTextAlone) {
  EXPECT_EQ(childSeed(7, "trial 3"), std::stoull(sha256("7:trial 3").substr(0, 16), nullptr, 16));
  std::set<uint64_t> seen;
  for (int trial = 0; trial < 1000; ++trial) seen.insert(childSeed(7, std::to_string(trial)));
  EXPECT_EQ(seen.size(), 1000u);
  EXPECT_NE(childSeed(7, "3"), childSeed(8, "3"));
}

TEST(Random, NumbersHaveTheMomentsOfTheirDistributions) {
  Random random(1);
  constexpr int kN = 20000;
  double sum = 0, squares = 0, normalSum = 0, normalSquares = 0, tails = 0;
  for (int i = 0; i < kN; ++i) {
    const double u = random.uniform();
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    sum += u;
    squares += u * u;
    const double z = random.normal();
    normalSum += z;
    normalSquares += z * z;
    tails += std::abs(z) > 1.959963984540054 ? 1 : 0;
  }
  // Five standard errors each: of U they are sqrt(1/12/n), of U^2 sqrt(4/45/n), of z^2 sqrt(2/n).
  EXPECT_NEAR(sum / kN, 0.5, 5 * std::sqrt(1.0 / 12 / kN));
  EXPECT_NEAR(squares / kN, 1.0 / 3, 5 * std::sqrt(4.0 / 45 / kN));
  EXPECT_NEAR(normalSum / kN, 0, 5 * std::sqrt(1.0 / kN));
  EXPECT_NEAR(normalSquares / kN, 1, 5 * std::sqrt(2.0 / kN));
  EXPECT_NEAR(tails / kN, 0.05, 5 * std::sqrt(0.05 * 0.95 / kN));
}

TEST(Random, BinomialAndBelowAreUnbiased) {
  Random random(2);
  double successes = 0;
  std::array<int, 6> counts{};
  for (int i = 0; i < 6000; ++i) {
    successes += random.binomial(20, 0.3);
    ++counts[random.below(6)];
  }
  EXPECT_NEAR(successes / 6000, 6, 5 * std::sqrt(20 * 0.3 * 0.7 / 6000));
  for (int count : counts) EXPECT_NEAR(count, 1000, 5 * std::sqrt(6000 * 5.0 / 36));
  EXPECT_EQ(random.binomial(10, 0.0), 0);
  EXPECT_EQ(random.binomial(10, 1.0), 10);
}

TEST(Random, EveryOrderOfAShuffleIsEquallyLikely) {
  Random random(3);
  std::map<std::array<int, 3>, int> orders;
  for (int i = 0; i < 6000; ++i) {
    std::vector<int> items = {0, 1, 2};
    random.shuffle(items);
    ++orders[{items[0], items[1], items[2]}];
  }
  ASSERT_EQ(orders.size(), 6u);
  for (const auto& [order, count] : orders) EXPECT_NEAR(count, 1000, 5 * std::sqrt(6000 * 5.0 / 36));
}

}  // namespace
}  // namespace limen::psychometrics
