// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/bitmask/light_samples.h"

#include <bit>
#include <random>

#include "experiments/base/error.h"

namespace limen::techniques {
namespace {

/// Digits of `index` in `base`, mirrored behind the point (van der Corput).
double mirrored(int index, int base) {
  double value = 0.0, place = 1.0 / base;
  for (; index > 0; index /= base, place /= base) value += place * (index % base);
  return value;
}

std::vector<glm::dvec2> grid(int side, bool jittered) {
  std::vector<glm::dvec2> samples;
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) {
      const glm::dvec2 within =
          jittered ? glm::dvec2(j % 2 == 0 ? 0.25 : 0.75, i % 2 == 0 ? 0.75 : 0.25) : glm::dvec2(0.5);
      samples.push_back((glm::dvec2(i, j) + within) / double(side));
    }
  return samples;
}

}  // namespace

std::vector<std::string> lightSamplePatterns() {
  return {"regular_8",  "regular_16",  "regular_32",     "jittered_16", "random_128",
          "random_256", "random_1024", "stratified_256", "halton_256"};
}

bool isGridPattern(const std::string& pattern) {
  return pattern.starts_with("regular_") || pattern.starts_with("jittered_");
}

std::vector<glm::dvec2> lightSamples(const std::string& pattern, int64_t seed) {
  const size_t mark = pattern.rfind('_');
  const int number = std::stoi(pattern.substr(mark + 1));
  if (isGridPattern(pattern)) return grid(number, pattern.starts_with("jittered_"));
  std::vector<glm::dvec2> samples;
  if (pattern.starts_with("halton_")) {
    for (int i = 0; i < number; ++i) samples.emplace_back(mirrored(i + 1, 2), mirrored(i + 1, 3));
    return samples;
  }
  // The engine alone is the same everywhere; distributions are not.
  std::mt19937_64 random(static_cast<uint64_t>(seed));
  const auto unit = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  const bool stratified = pattern.starts_with("stratified_");
  const int side = 16;  // strata along the light; only 256 samples have them
  for (int i = 0; i < number; ++i) {
    const double x = unit(), y = unit();
    samples.push_back(stratified ? glm::dvec2(i % side + x, i / side + y) / double(side) : glm::dvec2(x, y));
  }
  return samples;
}

std::vector<uint32_t> lightMask(const scene::AreaLight& light, const std::vector<glm::dvec2>& samples) {
  std::vector<uint32_t> mask(samples.size() / 32, 0);
  for (size_t i = 0; i < samples.size(); ++i)
    if (light.contains(samples[i])) mask[i / 32] |= 1U << (i % 32);
  if (bitCount(mask) == 0)
    throw Error("none of the " + std::to_string(samples.size()) + " light samples lies on the light",
                "pattern", "give a pattern of more samples");
  return mask;
}

int bitCount(const std::vector<uint32_t>& mask) {
  int count = 0;
  for (const uint32_t word : mask) count += std::popcount(word);
  return count;
}

}  // namespace limen::techniques
