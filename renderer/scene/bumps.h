// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "renderer/scene/shapes.h"

namespace limen::scene {

/// Radius as a sum of waves over direction: a surface whose coarse levels lose one wave after another. Lies
/// between radius (1 - amplitude) and radius (1 + amplitude).
class Bumps {
 public:
  Bumps(double radius, double amplitude, int64_t seed);
  double radius(glm::dvec3 direction) const;

 private:
  struct Wave {
    glm::dvec3 vector;
    double phase;
  };
  double radius_, amplitude_;
  std::array<Wave, 6> waves_{};
};

}  // namespace limen::scene
