// SPDX-License-Identifier: BSD-3-Clause
// What is done where a field's own rays do not tell what a ray meets.
#pragma once

#include <variant>

#include "experiments/base/settings_table.h"

namespace limen::techniques {

struct NearByField {
  static constexpr const char *kKind = "field", *kSummary = "their rays are looked up like all others";
  static const SettingsTable<NearByField>& table();
};
struct NearTraced {
  static constexpr const char
      *kKind = "traced",
      *kSummary =
          "all rays of a pixel are traced if a look-up of one finds a surface that is nearer "
          "than the field's own rays are fine, or finds that something blocks it but not where";
  double footprints = 0.5;
  static const SettingsTable<NearTraced>& table();
};
/// At any distance: silhouettes as well as what is near.
struct DoubtfulTraced {
  static constexpr const char *
      kKind = "doubtful",
     *kSummary =
         "single rays are traced, near an object or not: those about which the field's rays around disagree, "
         "those that meet a surface nearer than these are fine, and those that are blocked but it is not "
         "known where";
  double reach = 0.5;
  double difference = 0.1;
  double footprints = 0.5;
  double capacity = 0.25;
  static const SettingsTable<DoubtfulTraced>& table();
};
using NearSetting = std::variant<NearByField, NearTraced, DoubtfulTraced>;
template <class S>
Binding<S> nearBinding(NearSetting S::*member) {
  return {member, "near", "Receivers that are near to an object, and rays about which its field is in doubt",
          "Gaitatzes 2012, section 4.4.2 (field); bench (traced, doubtful)"};
}

}  // namespace limen::techniques
