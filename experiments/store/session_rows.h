// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/store/rows.h"
#include "experiments/store/sessions.h"

namespace limen::store {

/// JSON as the store writes it. Bytes that are not UTF-8 (from a driver) must not stop a session.
std::string jsonText(const nlohmann::json& json);

std::vector<StudySession> selectSessions(sqlite3* database);
std::vector<StudyEvent> selectEvents(sqlite3* database, int64_t session);

}  // namespace limen::store
