// SPDX-License-Identifier: BSD-3-Clause
// Run lengths of codes: nothing is lost but what may be.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "renderer/visibility_fields/run_lengths.h"

namespace limen::visibility_fields {
namespace {

constexpr uint8_t kMiss = 255;

/// Slopes with misses between, as rows of a map have them.
std::vector<uint8_t> rowsOfCodes(size_t count) {
  std::mt19937 engine(2);
  std::vector<uint8_t> codes;
  while (codes.size() < count) {
    codes.insert(codes.end(), engine() % 300, kMiss);
    const double start = double(engine() % 200), slope = double(engine() % 100) / 100.0;
    for (unsigned i = 0, n = engine() % 50; i < n; ++i)
      codes.push_back(static_cast<uint8_t>(std::min(254.0, start + slope * i)));
  }
  return codes;
}

TEST(RunLengths, DecodingGivesBackWhatWasEncoded) {
  EXPECT_TRUE(encodeRuns({}).empty());
  const std::vector<uint8_t> codes = rowsOfCodes(100000);
  const std::vector<uint8_t> runs = encodeRuns(codes);
  EXPECT_EQ(decodeRuns(runs), codes);
  EXPECT_LT(runs.size(), codes.size());
  // 300 equal bytes are a run of 256 and one of 44.
  EXPECT_EQ(encodeRuns(std::vector<uint8_t>(300, 7)), (std::vector<uint8_t>{255, 7, 43, 7}));
}

TEST(RunLengths, LongerRunsStayWithinTheToleranceAndKeepMisses) {
  const std::vector<uint8_t> codes = rowsOfCodes(100000);
  size_t before = encodeRuns(codes).size();
  for (const int tolerance : {1, 2, 8}) {
    std::vector<uint8_t> changed = codes;
    lengthenRuns(changed, tolerance, kMiss);
    for (size_t i = 0; i < codes.size(); ++i) {
      ASSERT_LE(std::abs(int(changed[i]) - int(codes[i])), tolerance);
      ASSERT_EQ(changed[i] == kMiss, codes[i] == kMiss);
    }
    const size_t size = encodeRuns(changed).size();
    EXPECT_LT(size, before) << tolerance;
    before = size;
  }
}

}  // namespace
}  // namespace limen::visibility_fields
