// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/renderer/scene/scene_fixtures.h"

namespace limen::scene {
namespace {

using fixtures::build;

struct Runs {
  int64_t valid = 0, runs = 0;
};

Runs runsOf(const ItemStream& stream) {
  Runs out;
  bool before = false;
  for (size_t i = 0; i < stream.items.size(); ++i) {
    const bool valid = stream.items[i] != ItemStream::kInvalid;
    EXPECT_TRUE(!valid || stream.items[i] == i);
    out.valid += valid;
    out.runs += valid && !before;
    before = valid;
  }
  return out;
}

ItemStream streamOf(int64_t elements, double share, const std::string& distribution) {
  return *build("stream", {{"elements", elements}, {"valid_share", share}, {"distribution", distribution}})
              .items;
}

// Five standard deviations of a binomial distribution: 5 sqrt(0.6 x 0.4 x 100,000) = 775 items.
TEST(Streams, HaveTheShareOfValidItems) {
  for (const char* distribution : {"random", "one_block", "alternating"}) {
    const Runs found = runsOf(streamOf(100000, 0.6, distribution));
    EXPECT_NEAR(double(found.valid), 60000.0, 775.0) << distribution;
  }
  for (const char* distribution : {"random", "runs", "one_block", "alternating"}) {
    EXPECT_EQ(runsOf(streamOf(1000, 0.0, distribution)).valid, 0) << distribution;
    EXPECT_EQ(runsOf(streamOf(1000, 1.0, distribution)).valid, 1000) << distribution;
    EXPECT_TRUE(streamOf(0, 0.6, distribution).items.empty()) << distribution;
  }
}

TEST(Streams, PlaceValidItemsAsAsked) {
  EXPECT_EQ(runsOf(streamOf(1000, 0.25, "one_block")).runs, 1);
  EXPECT_EQ(runsOf(streamOf(1000, 0.5, "alternating")).runs, 500);
  // Runs of 64 items and gaps of 64 x 0.4 / 0.6 = 42.7: one in 106.7 items, their lengths geometric, whose
  // standard deviation is their mean. In a renewal process the number of runs, 3750, deviates by sqrt(3750)
  // sqrt(64^2 + 42.7^2) / 106.7 = 44, and that of valid items by sqrt(3750) sqrt((0.4 x 64)^2 + (0.6
  // x 42.7)^2) = 2217; five times that.
  const Runs found = runsOf(streamOf(400000, 0.6, "runs"));
  EXPECT_NEAR(double(found.runs), 3750.0, 221.0);
  EXPECT_NEAR(double(found.valid), 240000.0, 11085.0);
}

TEST(Streams, HaveKeysBelowTheNumberOfBuckets) {
  const ItemStream stream = *build("stream", {{"elements", int64_t{16000}}, {"buckets", int64_t{16}}}).items;
  std::vector<int> counts(16);
  for (const uint32_t key : stream.keys) ++counts.at(key);
  // 1000 each, give or take five standard deviations of a binomial distribution, 5 sqrt(1000 x 15 / 16) =
  // 153.
  for (const int count : counts) EXPECT_NEAR(count, 1000, 153);
}

TEST(Streams, DecideTheScenesHash) {
  const auto hashOf = [](int64_t seed) {
    return build("stream", {{"elements", int64_t{100}}, {"seed", seed}}).contentHash();
  };
  EXPECT_EQ(hashOf(1), hashOf(1));
  EXPECT_NE(hashOf(1), hashOf(2));
}

}  // namespace
}  // namespace limen::scene
