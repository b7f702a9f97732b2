// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/base/settings_table.h"
#include "renderer/techniques/many_lods/radiosity.h"

namespace limen::techniques {

/// What keeps surfaces from hiding themselves from lights, in units of what shadow maps are made of.
struct ShadowBias {
  double leaves = 0.0;
  double pixels = 1.0;
  double nearest = 2.0;
  static const SettingsTable<ShadowBias>& table();

  /// `leafRadius`: of what is drawn. `pixelSlope`: width of a pixel at distance 1.
  DepthBias of(double leafRadius, double pixelSlope) const {
    return {leaves * leafRadius, pixels * pixelSlope};
  }
};
inline constexpr const char* kShadowBiasText = "What keeps surfaces from hiding themselves from lights";

/// Width of the pixels of a hemisphere at distance 1, as they are on average over the directions
/// (many_lods::hemisphereView()).
double hemispherePixelSlope(int tilePx);

}  // namespace limen::techniques
