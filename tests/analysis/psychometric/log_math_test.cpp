// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/log_math.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace limen::analysis {
namespace {

void expectRelative(double value, long double expected, double tolerance) {
  EXPECT_NEAR(value, static_cast<double>(expected), tolerance * std::abs(static_cast<double>(expected)));
}

TEST(LogMath, AddsLogarithmsOfAnySize) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_DOUBLE_EQ(logAddExp(-1000.0, -1000.0), -1000.0 + std::log(2.0));
  EXPECT_DOUBLE_EQ(logAddExp(std::log(0.2), std::log(0.3)), std::log(0.5));
  EXPECT_EQ(logAddExp(-infinity, -3.0), -3.0);
  EXPECT_EQ(logAddExp(-infinity, -infinity), -infinity);
  EXPECT_EQ(logAddExp(1e300, -1e300), 1e300);
}

TEST(LogMath, HalfDevianceKeepsItsDigits) {
  for (const double x : {1.0, 7.0, 1000.0, 999999.0}) {
    for (const double off : {1e-9, 1e-4, 0.02, 0.3, 5.0}) {
      const double m = x * (1.0 + off);
      // x (ln(x/m) - 1 + m/x) = x (d - ln(1 + d)), d the rounded offset; a series where that cancels.
      const long double d = (static_cast<long double>(m) - x) / x;
      long double expected = x * (d - std::log1p(d));
      if (off < 1e-3) expected = x * d * d * (0.5L - d * (1.0L / 3 - d * (0.25L - d * (0.2L - d / 6))));
      expectRelative(halfDeviance(x, m, std::log(m)), expected, 1e-12);
    }
  }
  EXPECT_EQ(halfDeviance(0.0, 3.0, std::log(3.0)), 3.0);
  // A mean that has become 0 is known by its logarithm.
  EXPECT_DOUBLE_EQ(halfDeviance(2.0, 0.0, -800.0), 2.0 * (std::log(2.0) + 800.0) - 2.0);
}

/// Kahan's and Neumaier's sum, in extended precision.
class Sum {
 public:
  void add(long double value) {
    const long double next = sum_ + value;
    lost_ += std::abs(sum_) >= std::abs(value) ? (sum_ - next) + value : (value - next) + sum_;
    sum_ = next;
  }
  double value() const { return static_cast<double>(sum_ + lost_); }

 private:
  long double sum_ = 0.0, lost_ = 0.0;
};

TEST(LogMath, SaturatedChancesAreThoseOfTheBinomial) {
  for (const int64_t n : {1, 2, 15, 16, 17, 90, 1000, 1000000}) {
    for (const int64_t k : {int64_t{0}, int64_t{1}, n / 3, n / 2, n - 1, n}) {
      // The coefficient as a sum of logarithms, term by term.
      // Single terms are off by half a unit in their last place, so that the largest sums keep 13 digits.
      Sum sum;
      for (int64_t i = 1; i <= k; ++i) sum.add(std::log(static_cast<long double>(n - k + i) / i));
      if (k > 0) sum.add(k * std::log(static_cast<long double>(k) / n));
      if (k < n) sum.add((n - k) * std::log1p(-static_cast<long double>(k) / n));
      EXPECT_NEAR(logSaturatedChance(k, n), sum.value(), 1e-12 * std::abs(sum.value())) << k << " of " << n;
    }
  }
}

TEST(LogMath, RisingSumsAreSumsOfLogarithms) {
  for (const double p : {1e-12, 1e-3, 0.3, 1.0}) {
    for (const double r : {1e-14, 1e-9, 1e-6, 1e-3, 0.1, 5.0}) {
      for (const int64_t k : {0, 1, 30, 49, 200, 5000, 200000}) {
        long double value = 0.0, size = 0.0, byP = 0.0, byR = 0.0;
        for (int64_t i = 0; i < k; ++i) {
          const long double term = static_cast<long double>(p) + static_cast<long double>(i) * r;
          const long double log = p == 1.0 ? std::log1p(static_cast<long double>(i) * r) : std::log(term);
          value += log;
          size += std::abs(log);
          byP += 1.0L / term;
          byR += i / term;
        }
        const RisingSum sum = logRisingSum(p, r, k);
        // Against the size of its terms: where they have both signs, the sum may be anything.
        EXPECT_NEAR(sum.value, static_cast<double>(value), 1e-12 * static_cast<double>(size))
            << p << " " << r << " " << k;
        expectRelative(sum.byP, byP, 1e-10);
        expectRelative(sum.byR, byR, 1e-8);
      }
    }
  }
}

}  // namespace
}  // namespace limen::analysis
