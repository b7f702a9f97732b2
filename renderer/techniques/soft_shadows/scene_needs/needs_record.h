// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/techniques/soft_shadows/scene_needs/needs.h"

namespace limen::techniques {

/// What was found, in sentences: the choice, the target, the check at full size, what the times are, the
/// candidates that no other beats in both time and error, those beaten, and those that could not be tried.
std::vector<std::string> remarksOn(const SceneNeedsFound& found);
/// The figures in it.
std::vector<Counter> countersOf(const SceneNeedsFound& found);
/// What countersOf() returns.
std::vector<Quantity> needsQuantities();

}  // namespace limen::techniques
