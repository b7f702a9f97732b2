// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "experiments/base/quantity.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {

/// Costs of a picture of `pixels` pixels, `shaded` samples of which were shaded, of `window` x `window` each.
inline std::vector<Counter> sampleCosts(double shaded, double pixels, int window) {
  return {{"samples_per_px", shaded / pixels},
          {"samples_share_pct", 100.0 * shaded / (pixels * window * window)}};
}

inline std::vector<Quantity> sampleCostQuantities() {
  return {{"samples_per_px", "Samples shaded per pixel", "1/px", Direction::LowerIsBetter,
           "Holländer 2013, section 4.3.6"},
          {"samples_share_pct", "Share of the samples that were shaded", "%", Direction::LowerIsBetter,
           "Holländer 2013, Table 4.1"}};
}

}  // namespace limen::techniques
