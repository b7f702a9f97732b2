// SPDX-License-Identifier: BSD-3-Clause
#include "perception/psychometrics/random.h"

#include <bit>
#include <cassert>
#include <string>

#include "experiments/base/hash.h"
#include "perception/psychometrics/standard_sigmoid.h"

namespace limen::psychometrics {

uint64_t childSeed(uint64_t seed, std::string_view text) {
  const std::string hex = Sha256().update(std::to_string(seed)).update(":").update(text).hex();
  return std::stoull(hex.substr(0, 16), nullptr, 16);
}

Random::Random(uint64_t seed) {
  for (uint64_t& word : state_) {
    seed += 0x9e3779b97f4a7c15u;
    uint64_t z = seed;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    word = z ^ (z >> 31);
  }
}

uint64_t Random::bits() {
  const uint64_t result = std::rotl(state_[1] * 5, 7) * 9;
  const uint64_t shifted = state_[1] << 17;
  state_[2] ^= state_[0];
  state_[3] ^= state_[1];
  state_[1] ^= state_[2];
  state_[0] ^= state_[3];
  state_[2] ^= shifted;
  state_[3] = std::rotl(state_[3], 45);
  return result;
}

double Random::uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

uint64_t Random::below(uint64_t n) {
  assert(n > 0);
  // Values in the last, incomplete run of n numbers are redrawn.
  const uint64_t incomplete = (UINT64_MAX % n + 1) % n;
  uint64_t draw = bits();
  while (draw > UINT64_MAX - incomplete) draw = bits();
  return draw % n;
}

double Random::normal() {
  // Odd multiples of 2^-53: neither 0 nor 1.
  const double u = static_cast<double>(2 * (bits() >> 12) + 1) * 0x1p-53;
  return standardInverse(SigmoidFamily::Normal, u);
}

int Random::binomial(int n, double p) {
  int successes = 0;
  for (int i = 0; i < n; ++i) successes += chance(p) ? 1 : 0;
  return successes;
}

size_t Random::category(const std::vector<double>& probabilities) {
  assert(!probabilities.empty());
  const double u = uniform();
  double sum = 0.0;
  for (size_t i = 0; i + 1 < probabilities.size(); ++i) {
    sum += probabilities[i];
    if (u < sum) return i;
  }
  return probabilities.size() - 1;
}

}  // namespace limen::psychometrics
