// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/visibility_fields/near_receivers/near_setting.h"

namespace limen::techniques {

const SettingsTable<NearByField>& NearByField::table() {
  static const SettingsTable<NearByField> kTable = {};
  return kTable;
}

const SettingsTable<NearTraced>& NearTraced::table() {
  static const SettingsTable<NearTraced> kTable = {
      {&NearTraced::footprints,
       "footprints",
       {0.0, 32.0},
       "footprints",
       "Distance of a surface to the receiver, along a ray that was looked up, below which all rays of the "
       "pixel are traced, in distances at that surface between rays of the field"}};
  return kTable;
}

const SettingsTable<DoubtfulTraced>& DoubtfulTraced::table() {
  using S = DoubtfulTraced;
  static const SettingsTable<S> kTable = {
      {&S::reach,
       "reach",
       {0.0, 4.0},
       "texels",
       "Half the side of the square about a ray's direction in its map whose corners are looked up as well; "
       "0: none"},
      {&S::difference,
       "difference",
       {0.0, 1.0},
       "",
       "Rays are in doubt if what they may let through, by the rays of the field around, differs by more"},
      {&S::footprints,
       "footprints",
       {0.0, 32.0},
       "footprints",
       "Rays are in doubt if they meet a surface nearer to the receiver, in distances at that surface "
       "between rays of the field"},
      {&S::capacity,
       "capacity",
       {0.0001, 1.0},
       "",
       "Doubtful rays of the whole picture that the list takes, as a share of all its rays; if there are "
       "more, all are looked up and none is traced (doubtful_overflow)"}};
  return kTable;
}

}  // namespace limen::techniques
