// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cassert>
#include <string_view>
#include <vector>

#include "experiments/base/quantity.h"

namespace limen::techniques {

/// Bytes of what a technique makes of the scene or of its shadow map before it looks anything up.
inline Quantity structureBytes() {
  return {"structure_bytes", "Size of the structure", "byte", Direction::LowerIsBetter};
}

/// Shares of all pixels, by what their visibility came from.
inline std::vector<Quantity> pixelShares() {
  return {{"receivers_share", "Share of pixels that show a receiver", "", Direction::Neither},
          {"lit_share", "Share of pixels known to be lit", "", Direction::Neither},
          {"umbra_share", "Share of pixels known to be in the umbra", "", Direction::Neither},
          {"processed_share", "Share of pixels that are worked on", "", Direction::Neither}};
}

/// That of `all` with this name, which must be there.
inline Quantity counterOf(const std::vector<Quantity>& all, std::string_view name) {
  for (const Quantity& counter : all)
    if (counter.name == name) return counter;
  assert(false && "no such counter");
  return std::string(name);
}

}  // namespace limen::techniques
