// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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

}  // namespace limen::techniques
