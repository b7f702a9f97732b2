// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cassert>
#include <string_view>
#include <vector>

#include "renderer/techniques/soft_shadows/visibility_technique.h"

namespace limen::techniques {

/// The one in `all` with this name, which must exist.
inline Quantity counterOf(const std::vector<Quantity>& all, std::string_view name) {
  for (const Quantity& counter : all)
    if (counter.name == name) return counter;
  assert(false && "no such counter");
  return std::string(name);
}

/// Bytes of what a technique builds from the scene or its shadow map before any lookup.
inline Quantity structureBytes() {
  return {"structure_bytes", "Memory of the acceleration structure", "byte", Direction::LowerIsBetter};
}

/// Shares of all pixels, by what their visibility came from.
inline std::vector<Quantity> pixelShares() {
  const std::vector<Quantity> all = VisibilityTechnique::quantities();
  return {counterOf(all, "receivers_share"), counterOf(all, "lit_share"), counterOf(all, "umbra_share"),
          counterOf(all, "processed_share")};
}

}  // namespace limen::techniques
