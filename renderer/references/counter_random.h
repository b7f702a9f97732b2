// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

namespace limen::references {

/// Counter-based random numbers (the finaliser of SplitMix64): a sample depends only on seed, pixel and
/// index.
inline uint64_t mixBits(uint64_t x) {
  x += 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31);
}

/// In [0, 1)^2.
inline glm::dvec2 uniform2(uint64_t seed, uint64_t pixel, uint64_t sample) {
  const uint64_t bits = mixBits(mixBits(mixBits(seed) ^ pixel) ^ sample);
  return {double(bits >> 32) * 0x1p-32, double(bits & 0xffffffffU) * 0x1p-32};
}

/// Half-width of the 99.9 % confidence interval of a mean of N independent values in [0, 1], or of a weighted
/// mean of several such means. Hoeffding (1963): it deviates from its expectation by more than e with a
/// probability of at most 2 exp(-2 N e^2). The values need not be identically distributed, so stratification
/// only makes the bound more conservative; and of weights w that sum to 1 the squares sum to no more than 1.
inline double hoeffdingHalfWidth(int64_t samples) {
  return std::sqrt(std::log(2.0 / 0.001) / (2.0 * double(samples)));
}

/// Largest possible standard deviation of such a mean: a value in [0, 1] has a variance of at most 1/4
/// (Popoviciu 1935), and of weights that sum to 1 the squares sum to no more than 1.
inline double largestDeviation(int64_t samples) { return 0.5 / std::sqrt(double(samples)); }

}  // namespace limen::references
