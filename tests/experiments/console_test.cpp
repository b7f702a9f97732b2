// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/console.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace limen::experiments {
namespace {

using testing::HasSubstr;

TEST(Console, DurationsReadLikeTime) {
  EXPECT_EQ(describeDuration(0.2), "1 s");
  EXPECT_EQ(describeDuration(59.0), "59 s");
  EXPECT_EQ(describeDuration(200.0), "3 min 20 s");
  EXPECT_EQ(describeDuration(3720.0), "1 h 02 min");
}

TEST(Console, CutsBetweenCharacters) {
  EXPECT_EQ(cutToColumns("abc", 3), "abc");
  EXPECT_EQ(cutToColumns("abcd", 3), "ab…");
  EXPECT_EQ(cutToColumns("ä·öü", 4), "ä·öü");
  EXPECT_EQ(cutToColumns("ä·öüß", 4), "ä·ö…");
  EXPECT_EQ(cutToColumns("abc", 0), "");
}

TEST(Console, BarFitsAnyTerminal) {
  for (size_t columns = 0; columns < 200; ++columns) {
    const std::string bar =
        barText(12, 40, 2, 200.0, "soft_shadows/bitmask pattern=regular_8 · grid", columns);
    size_t width = 0;
    for (const char byte : bar) width += (static_cast<unsigned char>(byte) & 0xC0) != 0x80 ? 1 : 0;
    EXPECT_LE(width, columns);
  }
  const std::string bar = barText(12, 40, 2, 200.0, "soft_shadows/bitmask · grid", 120);
  EXPECT_THAT(bar, HasSubstr("12/40, 2 failed, 3 min 20 s left, soft_shadows/bitmask · grid"));
  // 12/40 of 30 cells.
  EXPECT_THAT(bar, HasSubstr("[#########---------------------]"));
}

TEST(Console, BarKnowsNoTimeBeforeTheFirstRunAndNoneAfterTheLast) {
  EXPECT_THAT(barText(0, 40, 0, -1.0, "", 120), testing::Not(HasSubstr("left")));
  EXPECT_THAT(barText(40, 40, 0, 0.0, "", 120), testing::Not(HasSubstr("left")));
  EXPECT_THAT(barText(0, 0, 0, -1.0, "", 120), HasSubstr("0/0"));
}

}  // namespace
}  // namespace limen::experiments
