// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "study/protocol/design.h"

namespace limen::study {

/// Trials of a design, without practice.
size_t trialsOf(const Design& design);

/// Parts with their conditions and trial counts, then blocks and trials in order, as text for people.
std::string describe(const Protocol& protocol, const Design& design, uint64_t seed, int participantNumber);
/// The same with variables and, for trials without a procedure, the hashes of their stimuli.
nlohmann::json describeAsJson(const Protocol& protocol, const Design& design, uint64_t seed,
                              int participantNumber);

}  // namespace limen::study
