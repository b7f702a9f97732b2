// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "perception/threshold_maps/settings.h"

namespace limen::techniques {

/// Settings of the model, and of how the GPU computes it.
inline perception::ThresholdMapSettings mapSettingsOf(const ParameterValues& map,
                                                      const ParameterValues& gpu = {}) {
  std::vector<Parameter> declared = perception::thresholdMapParameters();
  for (Parameter& parameter : perception::thresholdMapGpuParameters())
    declared.push_back(std::move(parameter));
  std::map<std::string, ParameterValue> given = map.all();
  given.insert(gpu.all().begin(), gpu.all().end());
  return perception::thresholdMapSettings(ParameterValues(declared, given));
}

}  // namespace limen::techniques
