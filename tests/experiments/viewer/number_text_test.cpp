// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/number_text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

namespace limen::viewer {
namespace {

/// Digits of the mantissa from the first that is not zero.
int significantDigits(const std::string& text) {
  const std::string mantissa = text.substr(0, text.find('e'));
  const size_t first = mantissa.find_first_of("123456789");
  if (first == std::string::npos) return 0;
  return static_cast<int>(
      std::count_if(mantissa.begin() + static_cast<long>(first), mantissa.end(),
                    [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }));
}

TEST(NumberText, HasTwoToFourDigitsAndTheRightValue) {
  for (const double sign : {1.0, -1.0})
    for (double value = 3.3e-9; value < 1e12; value *= 1.37) {
      const std::string text = numberText(sign * value);
      EXPECT_GE(significantDigits(text), 2) << text;
      EXPECT_LE(significantDigits(text), 4) << text;
      EXPECT_NEAR(std::stod(text), sign * value, 0.5001e-3 * value) << text;
    }
}

TEST(NumberText, RoundNumbers) {
  EXPECT_EQ(numberText(0.5), "0.50");
  EXPECT_EQ(numberText(0.0), "0");
  EXPECT_EQ(numberText(-0.0), "0");
  EXPECT_EQ(numberText(7.0), "7");
  EXPECT_EQ(numberText(1024.0), "1024");
  EXPECT_EQ(numberText(1e-6), "1.0e-06");
  EXPECT_EQ(numberText(2e7), "2.0e+07");
  EXPECT_EQ(numberText(std::numeric_limits<double>::quiet_NaN()), "");
  EXPECT_EQ(numberText(std::numeric_limits<double>::infinity()), "inf");
}

TEST(NumberText, BytesHaveThreeDigitsAndTheRightPrefix) {
  EXPECT_EQ(bytesText(0), "0 B");
  EXPECT_EQ(bytesText(999), "999 B");
  EXPECT_EQ(bytesText(1500), "1.50 kB");
  EXPECT_EQ(bytesText(999'999), "1.00 MB");
  EXPECT_EQ(bytesText(45'300'000), "45.3 MB");
  EXPECT_EQ(bytesText(1'234'000'000), "1.23 GB");
}

}  // namespace
}  // namespace limen::viewer
