// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/bumps.h"

#include <cmath>
#include <numbers>

namespace limen::scene {

Bumps::Bumps(double radius, double amplitude, int64_t seed) : radius_(radius), amplitude_(amplitude) {
  Random random(seed);
  for (size_t i = 0; i < waves_.size(); ++i) {
    waves_[i].vector = random.direction() * (2.0 + 2.5 * static_cast<double>(i));
    waves_[i].phase = random.uniform(0.0, 2.0 * std::numbers::pi);
  }
}

double Bumps::radius(glm::dvec3 direction) const {
  double sum = 0.0;
  for (const Wave& wave : waves_) sum += std::cos(glm::dot(wave.vector, direction) + wave.phase);
  return radius_ * (1.0 + amplitude_ * sum / static_cast<double>(waves_.size()));
}

}  // namespace limen::scene
