// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "experiments/descriptor.h"
#include "experiments/executor.h"

namespace limen::experiments {

/// The run's value of a parameter: its technique's, then its scene's, then `width` or `height`.
std::optional<ParameterValue> lookUp(const PlannedRun& run, const std::string& name);

/// True if the run has this technique and scene ("": any) and all these values.
bool matches(const PlannedRun& run, const std::string& technique, const std::string& scene,
             const Selection& where);

}  // namespace limen::experiments
