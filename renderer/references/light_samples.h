// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/references/counter_random.h"
#include "renderer/references/light_shape.h"
#include "renderer/scene/scene.h"

namespace limen::references {

/// Points on a light, or on a part of it, that the rays of each receiver are sent to.
struct LightSamples {
  const scene::AreaLight& light;
  const LightShapeMap& map;
  int64_t count = 0;  ///< for each receiver
  int side = 0;       ///< one in each cell of a square grid with so many cells along a side; 0: anywhere
  uint64_t seed = 1;
  uint64_t part = 0;  ///< number of the part: each has points of its own

  /// World position.
  glm::dvec3 point(uint64_t pixel, int64_t sample) const {
    const glm::dvec2 random = uniform2(seed, pixel, part << 32U | static_cast<uint64_t>(sample));
    if (side == 0) return light.point(map(random));
    return light.point(
        map((glm::dvec2(double(sample % side), double(sample / side)) + random) / double(side)));
  }
};

}  // namespace limen::references
