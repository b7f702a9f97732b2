// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/base/settings_table.h"
#include "renderer/frame/compute_raster.h"

namespace limen::techniques {

/// The shadow map that a technique reads; included in its settings.
struct MapSettings {
  int resolution = 1024;  ///< texels per side
  frame::Raster raster = frame::Raster::Auto;
  static const SettingsTable<MapSettings>& table();
};

/// Depth bias by the receiver's slope: how much nearer to the light than a receiver an occluder must be to
/// count. Source: Schwarz 2009, section 4.4.5.
struct SlopeBias {
  static constexpr const char *kKind = "receiver_slope", *kSummary = "by the receiver's slope over a texel";
  double constant = 1e-4;  ///< share of the receiver's distance from the light's plane
  double slope = 1.0;      ///< texels of the level read
  double maxSlope = 10.0;  ///< slope of depth, relative to distance and tangent, up to which the bias grows
  static const SettingsTable<SlopeBias>& table();
};

}  // namespace limen::techniques
