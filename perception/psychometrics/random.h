// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

namespace limen::psychometrics {

/// Seed of a part, derived statelessly from the overall seed and a text that names the part: what trial "7"
/// draws depends only on the seed and "7". First 64 bits of the SHA-256 of "SEED:TEXT".
uint64_t childSeed(uint64_t seed, std::string_view text);

/// xoshiro256** (Blackman and Vigna 2021, ACM TOMS 47(4)), its state filled by SplitMix64 (Steele, Lea and
/// Flood 2014) as its authors advise. The same seed gives the same numbers everywhere.
class Random {
 public:
  explicit Random(uint64_t seed);

  uint64_t bits();   ///< 64 random bits
  double uniform();  ///< 0 <= u < 1, a multiple of 2^-53
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  uint64_t below(uint64_t n);  ///< 0 ... n - 1 without bias; n > 0
  bool chance(double p) { return uniform() < p; }
  double normal();  ///< mean 0, SD 1, by inversion: one generator output each
  double normal(double mean, double sd) { return mean + sd * normal(); }
  int binomial(int n, double p);  ///< successes in n trials; time proportional to n
  /// Index drawn with these probabilities, which sum to 1.
  size_t category(const std::vector<double>& probabilities);

  /// Every order equally likely (Fisher and Yates; Durstenfeld 1964).
  template <class T>
  void shuffle(std::vector<T>& items) {
    for (size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[below(i)]);
  }

 private:
  uint64_t state_[4];
};

}  // namespace limen::psychometrics
