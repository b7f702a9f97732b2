// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/text.h"

#include <gtest/gtest.h>

namespace limen {
namespace {

const std::vector<std::string> kNames = {"soft_shadows/bitmask", "soft_shadows/pcss", "soft_shadows/hard"};

TEST(NearestName, FindsSlips) {
  EXPECT_EQ(nearestName("soft_shadows/bitmsak", kNames), "soft_shadows/bitmask");
  EXPECT_EQ(nearestName("pcss", kNames), "soft_shadows/pcss");
  EXPECT_EQ(nearestName("frmaes", {"warmup", "frames"}), "frames");
}

TEST(NearestName, StaysSilentWhenNothingIsNear) {
  EXPECT_EQ(nearestName("quaternion", {"warmup", "frames"}), "");
  EXPECT_EQ(nearestName(std::string(100000, 'z'), kNames), "");
}

TEST(ShortestNumber, ReadsBackToTheSameValue) {
  EXPECT_EQ(shortestNumber(0.1), "0.1");
  for (const double value : {1.0 / 3.0, 1e-300, 123456789.125})
    EXPECT_EQ(std::stod(shortestNumber(value)), value);
}

}  // namespace
}  // namespace limen
