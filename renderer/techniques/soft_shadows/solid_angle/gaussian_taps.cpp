// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/solid_angle/gaussian_taps.h"

#include <cmath>
#include <random>

namespace limen::techniques {

std::vector<glm::vec4> gaussianTaps(int count, double sigma, int64_t seed) {
  // Only the engine is the same everywhere; distributions are not.
  std::mt19937_64 random(static_cast<uint64_t>(seed));
  const auto unit = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  const auto density = [&](glm::dvec2 at) {  // up to a factor; 1 in the middle
    const glm::dvec2 off = at - 0.5;
    return std::exp(-0.5 * glm::dot(off, off) / (sigma * sigma));
  };
  const double whole =
      std::pow(sigma * std::sqrt(6.283185307179586) * std::erf(0.5 / (sigma * std::sqrt(2.0))), 2);
  std::vector<glm::dvec2> places;
  // Darts thrown by the density; a dart is rejected if it lands nearer to another than `reach` times the side
  // of the square available to a point at that density. Packed discs reach at most 1.07 of it.
  double reach = 1.0;
  constexpr int kPatience = 64;  // consecutive rejected darts before the distance is reduced
  for (int misses = 0; static_cast<int>(places.size()) < count;) {
    const glm::dvec2 at(unit(), unit());
    if (unit() > density(at)) continue;
    const double apart = reach * std::sqrt(whole / (density(at) * count));
    bool free = true;
    for (const glm::dvec2 other : places) free = free && glm::distance(at, other) >= apart;
    if (free) {
      places.push_back(at);
      misses = 0;
    } else if (++misses == kPatience) {
      reach *= 0.97;
      misses = 0;
    }
  }
  double sum = 0.0;
  for (const glm::dvec2 at : places) sum += 1.0 / density(at);
  std::vector<glm::vec4> out;
  for (const glm::dvec2 at : places) out.emplace_back(at, 1.0 / (density(at) * sum), 0.0);
  return out;
}

}  // namespace limen::techniques
