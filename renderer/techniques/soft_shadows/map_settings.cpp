// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/map_settings.h"

namespace limen::techniques {

const SettingsTable<MapSettings>& MapSettings::table() {
  static const SettingsTable<MapSettings> kTable = {
      {&MapSettings::resolution, "resolution", oneOf({1, 2, 64, 128, 256, 512, 1024, 2048, 4096}), "texel",
       "Side of the shadow map", "Schwarz 2009, section 4.5"},
      {&MapSettings::raster, "raster",
       "How the shadow map is rasterised: in compute shaders or by the driver; auto: whichever was measured "
       "to be "
       "faster"}};
  return kTable;
}

const SettingsTable<SlopeBias>& SlopeBias::table() {
  static const SettingsTable<SlopeBias> kTable = {
      {&SlopeBias::constant,
       "constant",
       {0.0, 0.1},
       "",
       "Constant depth bias as a share of the receiver's distance from the light's plane",
       "Schwarz 2009, section 4.4.5 (value not given there)"},
      Binding(&SlopeBias::slope, "slope", Range{0.0, 16.0}, "texel",
              "Depth bias by the receiver's slope, in texels of the level read",
              "Schwarz 2009, section 4.4.5 (reconstructed)")
          .formerly({"slope_bias"}),
      Binding(&SlopeBias::maxSlope, "max_slope", Range{0.1, 1e6}, "",
              "Slope of depth, relative to distance and light-space tangent, up to which the bias grows")
          .formerly({"max_slope"})};
  return kTable;
}

}  // namespace limen::techniques
