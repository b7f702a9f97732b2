// SPDX-License-Identifier: BSD-3-Clause
#include "perception/metrics/jnd/jnd_settings.h"

namespace limen::perception {

const SettingsTable<ShownSettings>& ShownSettings::table() {
  using S = ShownSettings;
  static const SettingsTable<S> kTable = {
      {&S::exposure, "exposure", {1e-6, 1e6}, "", "Factor on the light; light of 1 is the display's white"},
      {&S::ambient,
       "ambient",
       {0, 1},
       "",
       "Ambient share of the albedo, for products that are shares of the direct light"},
      {&S::diffuse,
       "diffuse",
       {0, 1},
       "",
       "Share of the albedo times the cosine towards the light, which such a product is multiplied by"},
      {&S::background, "background", {0, 1}, "", "Light where such a product has no surface"}};
  return kTable;
}

const SettingsTable<JndSettings>& JndSettings::table() {
  using S = JndSettings;
  static const SettingsTable<S> kTable = {
      included(&S::viewing),
      included(&S::shown),
      included(&S::region),
      {&S::predictor, "predictor", "Model of the viewer, eye movement included: the popping predictor",
       "Schwarz 2009, section 10.3"}};
  return kTable;
}

}  // namespace limen::perception
