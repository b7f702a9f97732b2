// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <variant>

#include "experiments/base/settings_table.h"
#include "perception/multiscale/plane.h"

namespace limen::perception {

// Which contrasts mask a contrast besides itself.

struct NoNeighbours {
  static constexpr const char *kKind = "none", *kSummary = "none: masking is point-wise, as in the thesis";
};

/// Point-wise extended masking of JPEG 2000: a response T(x) is divided by 1 + strength mean(|x_k|^beta), x_k
/// being the contrasts over their thresholds within a square around it on the same band and in the same
/// channel, without itself. With T(x) = sign(x) |x|^alpha (masking: self) and no dead zone this is the
/// published form; there, the x_k are quantised, so that invisible ones are 0. Here they count by what they
/// exceed the dead zone: mean(max(0, |x_k|^beta - deadZone^beta)). Without one, rounding errors of 1e-6
/// thresholds would count as 6 % of a contrast at threshold. Sources: Zeng, Daly and Lei 2002 (An overview of
/// the visual optimization tools in JPEG 2000); Schwarz 2009, section 9.1.2, in words; constants for
/// contrasts over thresholds are choices.
struct ExtendedMasking {
  static constexpr const char
      *kKind = "extended",
      *kSummary = "those around it on its band, as in point-wise extended masking of JPEG 2000";
  int radiusPx = 2;  ///< of the square of (2 radius + 1)^2 pixels of the band's level
  double exponent = 0.2;
  double strength = 1.0;
  double deadZone = 1.0;  ///< over thresholds: contrasts up to this mask no other
  static const SettingsTable<ExtendedMasking>& table();
};

/// Largest radius: a group of the GPU holds the pixels around it.
inline constexpr int kMostMaskingRadius = 6;

/// What a response is divided by for what is around it, at each pixel: at least 1. `stepPx`: distance of a
/// level's neighbouring samples, for bands at full size. Beyond the border lies the nearest pixel.
Plane neighbourhoodElevation(const Plane& normalised, const ExtendedMasking& masking, int stepPx = 1);

}  // namespace limen::perception
