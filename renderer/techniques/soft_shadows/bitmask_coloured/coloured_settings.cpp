// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/bitmask_coloured/coloured_settings.h"

namespace limen::techniques {

const SettingsTable<ColourTable>& ColourTable::table() {
  static const SettingsTable<ColourTable> kTable = {
      Binding(&ColourTable::groupBits, "group_bits", oneOf({4, 8, 16}), "",
              "Samples in a group of the table; its memory doubles with each",
              "Schwarz 2009, section 4.2.2 (8)")
          .formerly({"group_bits"})};
  return kTable;
}

const SettingsTable<ColouredSettings>& ColouredSettings::table() {
  using S = ColouredSettings;
  static const SettingsTable<S> kTable = {
      included(&S::search),
      maskedOccludersBinding(&S::occluders),
      levelsBinding(&S::levels),
      passesBinding(&S::passes),
      patternBinding(&S::pattern),
      mapsBinding(&S::maps),
      {&S::colours, "colours", "How the emission of visible samples is summed",
       "Schwarz 2009, section 4.2.2 (samples: bench)"}};
  return kTable;
}

void ColouredSettings::check() const {
  const OccluderChoice choice = occluderChoice(occluders);
  checkBias(search, choice);
  checkLevels(search, choice, anyLevels(levels));
  checkSamples(occluders, sampleChoice(pattern).pattern);
  checkMaps(maps, search);
}

bool ColouredSettings::prefilters() const {
  return std::visit(
      [](const auto& chosen) {
        if constexpr (requires { chosen.prefilter; })
          return chosen.prefilter;
        else
          return false;
      },
      pattern);
}

}  // namespace limen::techniques
