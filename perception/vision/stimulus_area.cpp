// SPDX-License-Identifier: BSD-3-Clause
#include "perception/vision/stimulus_area.h"

namespace limen::perception {

const SettingsTable<FixedArea>& FixedArea::table() {
  static const SettingsTable<FixedArea> kTable = {
      {&FixedArea::deg2, "deg2", {1e-6, 1e5}, "deg2", "the area", "Schwarz 2009, section 10.3.3"}};
  return kTable;
}

}  // namespace limen::perception
