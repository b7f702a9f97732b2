// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "experiments/store/sessions.h"
#include "study/session/event.h"
#include "study/session/front_end.h"
#include "study/session/session.h"

namespace limen::study {

/// The event with the rows that follow from it, `before` being the session just before it is applied.
/// `frames` are those of the trial that the event ends. Used to write a session and, during replay, to check
/// what was written.
store::StudyEntry entryOf(const Session& before, const Event& event,
                          const std::vector<ShownFrame>& frames = {});
std::vector<store::StudyBlock> blocksOf(const Session& session);
std::vector<store::StudyFrame> framesOf(const std::vector<ShownFrame>& frames);
/// {"count", "sha256"} of a frame log: part of its event, so that the event log authenticates it.
nlohmann::json frameDigest(const std::vector<store::StudyFrame>& frames);
Event eventOf(const store::StudyEvent& row);
/// Runs `work` on an event of a store; what it finds wrong is said with file, table and row.
void atEvent(const store::StudyEvent& row, const std::string& store, const std::function<void()>& work);

}  // namespace limen::study
