// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/backprojection/backprojection_settings.h"

namespace limen::techniques {
namespace {

template <class S>
Binding<S> areaBinding() {
  return Binding(&S::area, "area",
                 "Area that a microquad adds: its size, or with the sign of its orientation, so that folds "
                 "cancel",
                 "Schwarz 2009, section 4.4.1 (open there)")
      .formerly({"quad_area"});
}

}  // namespace

const SettingsTable<SummedMicroquads>& SummedMicroquads::table() {
  static const SettingsTable<SummedMicroquads> kTable = {areaBinding<SummedMicroquads>()};
  return kTable;
}

const SettingsTable<SummedMicrotris>& SummedMicrotris::table() {
  static const SettingsTable<SummedMicrotris> kTable = {areaBinding<SummedMicrotris>()};
  return kTable;
}

const SettingsTable<Contours>& Contours::table() {
  static const SettingsTable<Contours> kTable = {
      Binding(&Contours::inset, "inset", Range{0.0, 1.0}, "",
              "Position of contours (t): 0 along the borders of blocking texels, 1 through their centres",
              "Schwarz 2009, section 4.4.5 (after Guennebaud 2007)")
          .formerly({"contour_inset"})};
  return kTable;
}

const SettingsTable<MorphingMicroquads>& MorphingMicroquads::table() {
  static const SettingsTable<MorphingMicroquads> kTable = {
      Binding(&MorphingMicroquads::morphLevel, "level", Range{0.0, 12.0}, "",
              "Level, between two of the shadow map's, to which microquads have moved",
              "Schwarz 2009, section 5.1.2")
          .formerly({"morph_level"}),
      areaBinding<MorphingMicroquads>()};
  return kTable;
}

const SettingsTable<BackprojectionSettings>& BackprojectionSettings::table() {
  using S = BackprojectionSettings;
  static const SettingsTable<S> kTable = {
      included(&S::search),
      {&S::occluders, "occluders", "Type of micro-occluder made from blocking texels",
       "Schwarz 2009, sections 4.1, 4.4.1, 4.4.3, 4.4.5, 4.5.1 and 5.1.2"},
      levelsBinding(&S::levels),
      passesBinding(&S::passes)};
  return kTable;
}

void BackprojectionSettings::check() const {
  const OccluderChoice choice = occluderChoice(occluders);
  checkBias(search, choice);
  checkLevels(search, choice, levels);
}

}  // namespace limen::techniques
