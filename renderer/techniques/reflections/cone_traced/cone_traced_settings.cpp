// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/reflections/cone_traced/cone_traced_settings.h"

#include "experiments/base/error.h"

namespace limen::techniques {

const SettingsTable<FillNothing>& FillNothing::table() {
  static const SettingsTable<FillNothing> kTable = {};
  return kTable;
}
const SettingsTable<FillBackground>& FillBackground::table() {
  static const SettingsTable<FillBackground> kTable = {};
  return kTable;
}
const SettingsTable<FillRescaled>& FillRescaled::table() {
  static const SettingsTable<FillRescaled> kTable = {};
  return kTable;
}
const SettingsTable<FillEnvironment>& FillEnvironment::table() {
  static const SettingsTable<FillEnvironment> kTable = {
      {&FillEnvironment::resolution, "resolution", oneOf({16, 32, 64, 128, 256}), "texels", "Side of a face",
       "low in Roger 2008, section 5.2.4 (value not given there)"}};
  return kTable;
}

const SettingsTable<SortedLayers>& SortedLayers::table() {
  static const SettingsTable<SortedLayers> kTable = {};
  return kTable;
}
const SettingsTable<PeeledLayers>& PeeledLayers::table() {
  static const SettingsTable<PeeledLayers> kTable = {{&PeeledLayers::room,
                                                      "room",
                                                      {1, 1 << 26},
                                                      "pairs",
                                                      "Pairs of a pixel and a triangle that may be drawn",
                                                      "2048 x 2048 in Roger 2008, section 3.3.4"}};
  return kTable;
}

void ConeTracedSettings::check() const {
  if (std::holds_alternative<PeeledLayers>(backEnd) && coverage == ConeCoverage::Masked)
    throw Error("peeled layers are blended without a mask", "coverage", "choose saturated, or sorted layers");
}

const SettingsTable<ConeTracedSettings>& ConeTracedSettings::table() {
  using S = ConeTracedSettings;
  static const SettingsTable<S> kTable = {
      {&S::glossScale,
       "gloss_scale",
       {0.0, 10.0},
       "",
       "Factor of the materials' gloss; 0: antialiasing alone",
       "Roger 2008, section 5.2.2"},
      {&S::reflection, "reflection", "How a pixel's cone widens at a curved mirror",
       "Roger 2008, section 5.2.2 (formulas not given there)"},
      {&S::layers,
       "layers",
       {1, 256},
       "triangles",
       "Triangles of a cone at most, the nearest ones",
       "n of Roger 2008, section 5.2.4 (1 to 250)"},
      {&S::leastShare,
       "least_share",
       {0.0, 0.5},
       "",
       "Triangles that fill less of a cone are left out",
       "Roger 2008, section 5.2.4 (0.01, 0.02, 0.05)"},
      {&S::contribution, "contribution",
       "What a triangle contributes: the share that it fills, or by a table", "Roger 2008, section 5.2.3"},
      {&S::coverage, "coverage",
       "What hides what within a cone: whatever is nearer until it is full, or a mask of 64 places, which "
       "knows "
       "triangles that hold one",
       "saturated in Roger 2008, section 5.2.4; the mask is the bench's own"},
      {&S::fill, "fill", "What a cone shows where nothing covers it", "Roger 2008, section 5.2.4"},
      {&S::backEnd, "back_end", "How the nearest triangles of a cone are found and blended",
       "peeled in Roger 2008, section 5.2.4; a sort is suggested there"},
      {&S::farRadius,
       "far_radius",
       {0.0, 1.0},
       "scene diagonals",
       "Cones end where their radius is this; 0: nowhere",
       "Roger 2008, section 5.2.6 (value not given there)"},
      {&S::filterPatterns, "filter_patterns",
       "Filters textures as wide as a triangle's overlap with the cone", "Roger 2008, section 5.2.3"},
      {&S::traversal, "traversal", "Cones against triangles"},
      shadingBinding(&S::shading)};
  return kTable;
}

}  // namespace limen::techniques
