// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <boost/math/distributions/binomial.hpp>

namespace limen::study {

/// Whether `successes` of `trials` is what a rate of `p` gives: neither tail of the binomial distribution
/// beyond it is below 1e-6. Seeds are fixed, so that this is decided once and for all.
inline ::testing::AssertionResult isRate(int successes, int trials, double p) {
  if (p <= 0.0 || p >= 1.0) {
    const int expected = p <= 0.0 ? 0 : trials;
    if (successes == expected) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << successes << " of " << trials << " for a rate of " << p;
  }
  const boost::math::binomial_distribution<double> distribution(trials, p);
  const double upTo = boost::math::cdf(distribution, successes);
  const double from =
      successes == 0 ? 1.0 : boost::math::cdf(boost::math::complement(distribution, successes - 1));
  if (upTo > 1e-6 && from > 1e-6) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << successes << " of " << trials << " for a rate of " << p;
}

}  // namespace limen::study
