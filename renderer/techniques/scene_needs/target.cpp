// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/scene_needs/target.h"

namespace limen::techniques {

const SettingsTable<RmseTarget>& RmseTarget::table() {
  static const SettingsTable<RmseTarget> kTable = {
      {&RmseTarget::value, "value", {0.0, 1.0}, "", "Largest RMSE that is good enough"}};
  return kTable;
}

const SettingsTable<JndTarget>& JndTarget::table() {
  using S = JndTarget;
  static const SettingsTable<S> kTable = {
      {&S::value, "value", {0.0, 100.0}, "JND", "Largest visible difference that is good enough"},
      {&S::figure, "figure", "Over the pixels that are compared: their median, 95th percentile or largest"},
      included(&S::viewing)};
  return kTable;
}

std::string measureOf(const NeedsTarget& target) {
  const auto* jnd = std::get_if<JndTarget>(&target);
  return jnd ? std::string(limen::toText(jnd->figure)) + " of JND on " + jnd->viewing.display.name : "RMSE";
}

}  // namespace limen::techniques
