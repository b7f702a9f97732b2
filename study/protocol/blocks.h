// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "study/protocol/design.h"
#include "study/protocol/order.h"

namespace limen::study {

/// Blocks of a part in the order of Part::blockLevels, their trials condition by condition, without practice,
/// numbers and the targets of intervals and alternatives. `firstProcedure`: number of the part's first
/// procedure. The same for all participants, so that the existence of their orders can be checked.
std::vector<PlannedBlock> unorderedBlocks(const Part& part, int partNumber, int firstProcedure);

/// Limits of Part::trialOrder on these trials.
std::vector<RunLimit> runLimits(const Part& part, const std::vector<PlannedTrial>& trials);

/// Trials of the part, without practice.
size_t trialCount(const Part& part);

/// Balances targets: each alternative equally often within a condition, with the remainder drawn so that it
/// evens out over the trials.
void setTargets(const Part& part, std::vector<PlannedTrial>& trials, uint64_t seed);

/// Balances what unchanged stimuli show in the same way: catch trials, and all trials of intervals and
/// alternatives.
void setUnchanged(const Part& part, std::vector<PlannedTrial>& trials, uint64_t seed);

}  // namespace limen::study
