// SPDX-License-Identifier: BSD-3-Clause
// The bound on what a sampled reference adds to the difference of two products' errors, against simulation.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "experiments/measured_quantities.h"

namespace limen::experiments {
namespace {

constexpr int kSamples = 16, kPixels = 400, kTrials = 4000;
/// Values that are 0 or 1 with equal chances have the largest variance there is in [0, 1], 1/4; a mean of 16
/// has the standard deviation 0.5 / 4.
constexpr double kDeviation = 0.125;

using Pixels = std::vector<double>;

double meanAbsolute(const Pixels& product, const Pixels& reference) {
  double sum = 0.0;
  for (size_t i = 0; i < product.size(); ++i) sum += std::abs(product[i] - reference[i]);
  return sum / static_cast<double>(product.size());
}

double rootMeanSquare(const Pixels& product, const Pixels& reference) {
  double sum = 0.0;
  for (size_t i = 0; i < product.size(); ++i)
    sum += (product[i] - reference[i]) * (product[i] - reference[i]);
  return std::sqrt(sum / static_cast<double>(product.size()));
}

struct Spread {
  double deviation = 0.0, beyondBound = 0.0;
};

/// Of the difference of two products' errors over references that are sampled afresh.
Spread spreadOf(const Pixels& a, const Pixels& b,
                const std::function<double(const Pixels&, const Pixels&)>& error) {
  std::mt19937_64 random(7);
  std::vector<double> differences;
  double mean = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    Pixels reference(kPixels);
    for (double& value : reference)
      value = static_cast<double>(__builtin_popcountll(random() & 0xffffU)) / kSamples;
    differences.push_back(error(a, reference) - error(b, reference));
    mean += differences.back() / kTrials;
  }
  Spread spread;
  for (const double difference : differences) {
    spread.deviation += (difference - mean) * (difference - mean) / (kTrials - 1);
    if (std::abs(difference - mean) > noiseOfDifference(kDeviation, kPixels))
      spread.beyondBound += 1.0 / kTrials;
  }
  spread.deviation = std::sqrt(spread.deviation);
  return spread;
}

TEST(ReferenceNoise, BoundsTheDifferenceOfTwoErrorsAndIsReachedByOppositeProducts) {
  // |0 - r| - |1 - r| = 2 r - 1: the standard deviation of its mean is 2 x 0.125 / 20, the bound itself.
  const Pixels black(kPixels, 0.0), white(kPixels, 1.0);
  const Spread opposite = spreadOf(black, white, meanAbsolute);
  EXPECT_NEAR(opposite.deviation, 0.0125, 0.0125 * 0.05)
      << "4.5 standard errors of a deviation from 4000 trials";
  EXPECT_NEAR(opposite.beyondBound, 0.05, 0.015) << "95 % lie within; 4 standard errors";
}

TEST(ReferenceNoise, ProductsThatAreAlikeLieWellWithinIt) {
  std::mt19937_64 random(3);
  Pixels a(kPixels), b(kPixels);
  for (size_t i = 0; i < a.size(); ++i) {
    a[i] = static_cast<double>(random() % 1000) / 1000.0;
    b[i] = std::min(1.0, a[i] + static_cast<double>(random() % 100) / 1000.0);
  }
  for (const auto& error : {meanAbsolute, rootMeanSquare}) {
    const Spread spread = spreadOf(a, b, error);
    EXPECT_LT(spread.deviation, 0.0125);
    EXPECT_LT(spread.beyondBound, 0.05);
  }
}

TEST(ReferenceNoise, FallsWithTheRootOfThePixels) {
  // 256 samples (0.5 / 16) and 50,000 pixels: 1.96 x 2 x 0.03125 / 223.6.
  EXPECT_NEAR(noiseOfDifference(0.03125, 50'000), 5.48e-4, 1e-6);
}

}  // namespace
}  // namespace limen::experiments
