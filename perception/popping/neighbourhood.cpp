// SPDX-License-Identifier: BSD-3-Clause
#include "perception/popping/neighbourhood.h"

#include <algorithm>
#include <cmath>

namespace limen::perception {

const SettingsTable<ExtendedMasking>& ExtendedMasking::table() {
  using S = ExtendedMasking;
  constexpr const char *kText = "Zeng, Daly and Lei 2002; Schwarz 2009, section 9.1.2", *kOwn = "choice";
  static const SettingsTable<S> kTable = {
      {&S::radiusPx,
       "radius_px",
       {1, kMostMaskingRadius},
       "px",
       "reach of the neighbourhood, in pixels of each level",
       kText},
      {&S::exponent, "beta", {0.05, 2.0}, "", "exponent of the neighbours' contrasts", kText},
      {&S::strength, "strength", {0.0, 1e3}, "", "factor of the neighbours' mean", kOwn},
      {&S::deadZone,
       "dead_zone",
       {0.0, 100.0},
       "",
       "contrast over its threshold up to which a neighbour masks nothing; 0: as published, where rounding "
       "errors "
       "mask",
       kOwn}};
  return kTable;
}

Plane neighbourhoodElevation(const Plane& normalised, const ExtendedMasking& masking, int stepPx) {
  const int width = normalised.width, height = normalised.height, radius = masking.radiusPx;
  const double least = masking.deadZone > 0.0 ? std::pow(masking.deadZone, masking.exponent) : 0.0;
  const double count = (2.0 * radius + 1.0) * (2.0 * radius + 1.0) - 1.0;
  Plane maskers(width, height), rows(width, height), out(width, height);
  forRowBlocks(height, static_cast<size_t>(width) * 60, [&](int first, int end) {
    for (int y = first; y < end; ++y) {
      for (int x = 0; x < width; ++x) {
        const double own = std::abs(normalised.at(x, y));
        maskers.at(x, y) = own > masking.deadZone ? std::pow(own, masking.exponent) - least : 0.0;
      }
      for (int x = 0; x < width; ++x)
        for (int d = -radius; d <= radius; ++d)
          rows.at(x, y) += maskers.at(std::clamp(x + d * stepPx, 0, width - 1), y);
    }
  });
  forRowBlocks(height, static_cast<size_t>(width) * 30, [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < width; ++x) {
        double sum = -maskers.at(x, y);
        for (int d = -radius; d <= radius; ++d) sum += rows.at(x, std::clamp(y + d * stepPx, 0, height - 1));
        out.at(x, y) = 1.0 + masking.strength * std::max(sum, 0.0) / count;
      }
  });
  return out;
}

}  // namespace limen::perception
