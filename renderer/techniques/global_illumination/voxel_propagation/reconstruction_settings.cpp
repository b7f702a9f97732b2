// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/global_illumination/voxel_propagation/reconstruction_settings.h"

#include <string>

namespace limen::techniques {

const SettingsTable<VisibleWeights>& VisibleWeights::table() {
  using S = VisibleWeights;
  static const SettingsTable<S> kTable = {
      {&S::widest,
       "widest",
       {1, 4},
       "voxels",
       "Around a point that has no light otherwise, as in crevices lower than a "
       "voxel, within which the nearest voxel whose lit face it sees lights it",
       "the bench's own"}};
  return kTable;
}

const SettingsTable<ReconstructionSettings>& ReconstructionSettings::table() {
  using S = ReconstructionSettings;
  static const SettingsTable<S> kTable = {
      {&S::from, "from", "What a pixel's light is computed from", "Gaitatzes 2012, section 5.5.3"},
      {&S::weights, "weights", "Which voxels a pixel's light is interpolated between",
       "Gaitatzes 2012, section 5.5.3 (occupied)"}};
  return kTable;
}

void ReconstructionSettings::define(gl::ShaderDefines& defines) const {
  defineEnum(defines, "GATHER", from);
  int number = 0;
  for (const char* name : {"VISIBLE", "OCCUPIED", "ALL"})
    defines["INTERPOLATION_" + std::string(name)] = std::to_string(number++);
  defines["INTERPOLATION"] = std::to_string(weights.index());
}

}  // namespace limen::techniques
