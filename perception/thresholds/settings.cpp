// SPDX-License-Identifier: BSD-3-Clause
#include "perception/thresholds/settings.h"

namespace limen::perception {

const SettingsTable<SingleOnGpu>& SingleOnGpu::table() {
  using S = SingleOnGpu;
  static const SettingsTable<S> kTable = {included(&S::map), {&S::gpu, "gpu", "How the GPU computes it"}};
  return kTable;
}

ThresholdSettings modelOf(const ThresholdGpuSettings& settings) {
  if (const auto* single = std::get_if<SingleOnGpu>(&settings)) return single->map;
  return std::get<BandThresholdSettings>(settings);
}

}  // namespace limen::perception
