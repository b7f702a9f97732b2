// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/selection.h"

#include <algorithm>

namespace limen::experiments {

std::optional<ParameterValue> lookUp(const PlannedRun& run, const std::string& name) {
  if (run.technique.values.has(name)) return run.technique.values.all().at(name);
  if (run.scene.values.has(name)) return run.scene.values.all().at(name);
  if (name == "width") return ParameterValue(int64_t{run.widthPx});
  if (name == "height") return ParameterValue(int64_t{run.heightPx});
  return {};
}

bool matches(const PlannedRun& run, const std::string& technique, const std::string& scene,
             const Selection& where) {
  if (!technique.empty() && run.technique.name != technique) return false;
  if (!scene.empty() && run.scene.name != scene) return false;
  return std::all_of(where.begin(), where.end(), [&](const auto& wanted) {
    const auto value = lookUp(run, wanted.first);
    return value && *value == wanted.second;
  });
}

}  // namespace limen::experiments
