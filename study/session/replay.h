// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/store/sessions.h"
#include "study/protocol/protocol.h"

namespace limen::study {

struct Verification {
  /// One line for each row that disagrees with the events; empty: all derived rows are correct.
  std::vector<std::string> differences;
  int events = 0;
  nlohmann::json state;  ///< Session::state() after the last event
};

/// Replays a stored session and compares every derived row (blocks, trials with their stimuli and hashes,
/// responses, frame logs, notes, form, state) with what follows from the events. `protocol` is the stored
/// one, parsed. Throws Error if the events are not a valid sequence.
Verification verifySession(const store::SessionReader& reader, const store::StudySession& session,
                           const Protocol& protocol);

}  // namespace limen::study
