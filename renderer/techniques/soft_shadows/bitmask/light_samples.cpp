// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/bitmask/light_samples.h"

#include <bit>
#include <cmath>
#include <random>
#include <string>

#include "experiments/base/error.h"

namespace limen::techniques {
namespace {

/// Digits of `index` in `base`, mirrored at the radix point (van der Corput).
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

std::vector<glm::dvec2> halton(int number) {
  std::vector<glm::dvec2> samples;
  for (int i = 0; i < number; ++i) samples.emplace_back(mirrored(i + 1, 2), mirrored(i + 1, 3));
  return samples;
}

std::vector<glm::dvec2> randomPlaces(int number, int64_t seed) {
  // Only the engine is the same everywhere; distributions are not.
  std::mt19937_64 random(static_cast<uint64_t>(seed));
  const auto unit = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  std::vector<glm::dvec2> samples;
  for (int i = 0; i < number; ++i) {
    const double x = unit(), y = unit();
    samples.emplace_back(x, y);
  }
  return samples;
}

std::vector<glm::dvec2> stratified(int side, int64_t seed) {
  std::vector<glm::dvec2> samples = randomPlaces(side * side, seed);
  for (int i = 0; i < side * side; ++i) {
    glm::dvec2& sample = samples[static_cast<size_t>(i)];
    sample = glm::dvec2(i % side + sample.x, i / side + sample.y) / double(side);
  }
  return samples;
}

}  // namespace

bool isGridPattern(LightPattern pattern) { return pattern <= LightPattern::Jittered16; }

void defineSamples(gl::ShaderDefines& defines, LightPattern pattern) {
  const size_t samples = lightSamples(pattern).size();
  defines["SAMPLES"] = std::to_string(samples);
  if (isGridPattern(pattern))
    defines["SAMPLES_ALONG"] = std::to_string(std::lround(std::sqrt(static_cast<double>(samples))));
  defineEnum(defines, "SAMPLE_PLACES",
             !isGridPattern(pattern)               ? SamplePlaces::Anywhere
             : pattern == LightPattern::Jittered16 ? SamplePlaces::JitteredGrid
                                                   : SamplePlaces::Grid);
}

std::vector<glm::dvec2> lightSamples(LightPattern pattern, int64_t seed) {
  switch (pattern) {
    case LightPattern::Regular8:
      return grid(8, false);
    case LightPattern::Regular16:
      return grid(16, false);
    case LightPattern::Regular32:
      return grid(32, false);
    case LightPattern::Jittered16:
      return grid(16, true);
    case LightPattern::Random128:
      return randomPlaces(128, seed);
    case LightPattern::Random256:
      return randomPlaces(256, seed);
    case LightPattern::Random1024:
      return randomPlaces(1024, seed);
    case LightPattern::Stratified256:
      return stratified(16, seed);
    case LightPattern::Halton256:
      return halton(256);
  }
  return {};
}

std::vector<uint32_t> lightMask(const scene::AreaLight& light, const std::vector<glm::dvec2>& samples) {
  std::vector<uint32_t> mask(samples.size() / 32, 0);
  for (size_t i = 0; i < samples.size(); ++i)
    if (light.contains(samples[i])) mask[i / 32] |= 1U << (i % 32);
  if (bitCount(mask) == 0)
    throw Error("none of the " + std::to_string(samples.size()) + " light samples lies on the light",
                "pattern", "choose a pattern with more samples");
  return mask;
}

int bitCount(const std::vector<uint32_t>& mask) {
  int count = 0;
  for (const uint32_t word : mask) count += std::popcount(word);
  return count;
}

}  // namespace limen::techniques
