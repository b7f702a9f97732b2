// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/techniques/scene_needs/needs.h"

namespace limen::techniques {

/// What was found, in sentences: the choice, the target, the check at full size, what the times are, the
/// candidates that no other beats in both time and error, those beaten, and those that could not be tried.
std::vector<std::string> remarksOn(const SceneNeedsFound& found);
/// What the check at full size says of the choice.
std::string checkRemark(const FullSizeCheck& check, const NeedsTarget& target);
/// What the check of all candidates at full size says, in sentences.
std::vector<std::string> wholeSetRemarks(const WholeSetCheck& check, const NeedsTarget& target);
/// The figures of the checks.
std::vector<Counter> checkCounters(const FullSizeCheck& check, const NeedsTarget& target);
std::vector<Counter> wholeSetCounters(const WholeSetCheck& check, const NeedsTarget& target);
/// What wholeSetCounters() returns.
std::vector<Quantity> wholeSetQuantities();
/// The figures in it.
std::vector<Counter> countersOf(const SceneNeedsFound& found);
/// What countersOf() returns.
std::vector<Quantity> needsQuantities();

}  // namespace limen::techniques
