// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <string>

#include "experiments/base/error.h"

namespace limen::references {

/// Side of a square grid of this many points, rounded.
inline int gridSide(int64_t samples) { return static_cast<int>(std::lround(std::sqrt(double(samples)))); }

/// Throws Error about parameter `samples` unless it is a square number. `otherwise`: an alternative remedy.
inline void checkSquareNumber(int64_t samples, const std::string& otherwise = {}) {
  const auto side = static_cast<int64_t>(gridSide(samples));
  if (side * side != samples)
    throw Error("'samples' is " + std::to_string(samples) + ", not a square number", "samples",
                "give " + std::to_string(side * side) + otherwise);
}

}  // namespace limen::references
