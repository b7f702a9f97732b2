// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "experiments/base/settings_table.h"
#include "renderer/many_lods/view_atlas.h"
#include "renderer/techniques/many_lods/radiosity.h"

namespace limen::techniques {

/// What keeps surfaces from hiding themselves from lights, in units of what shadow maps are made of.
struct ShadowBias {
  double leaves = 1.0;
  double pixels = 1.0;
  double nearest = 2.0;
  static const SettingsTable<ShadowBias>& table();

  /// `leafRadius`: of what is drawn. `pixelSlope`: width of a pixel at distance 1. Discs that have the depth
  /// of their planes are off by pixels alone, spheres by as much as nodes may be large, `epsilonPx`.
  DepthBias of(double leafRadius, double pixelSlope, many_lods::Discs discs, double epsilonPx) const {
    const double size = discs == many_lods::Discs::Spheres ? std::max(epsilonPx, 1.0) : 1.0;
    return {leaves * leafRadius, pixels * pixelSlope * size};
  }
};
inline constexpr const char* kShadowBiasText = "What keeps surfaces from hiding themselves from lights";

/// Width of the pixels of a hemisphere at distance 1, as they are on average over the directions
/// (many_lods::hemisphereView()).
double hemispherePixelSlope(int tilePx);

}  // namespace limen::techniques
