// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/store/database.h"
#include "experiments/store/store.h"

namespace limen::store {

/// Replaces measurements, frame times, passes and artefacts of the row `id` with those of `run`. Inside a
/// transaction.
void writeDetails(sqlite3* database, int64_t id, const Run& run);
/// The row `id` without its details. It exists.
Run readRunById(sqlite3* database, int64_t id);
/// Of a row of device, software and facts.
Environment readEnvironment(const Statement& row);
/// Fills measurements, passes, artefacts and (on request) frame times of `runs`, which have their ids.
void readDetails(sqlite3* database, std::vector<Run>& runs, bool withFrameTimes);

/// What a column that holds JSON must be.
enum class JsonIs { Any, Object, Array };
/// Throws Error (Statement::damaged) if the text is not JSON, another kind of JSON, or nested so deeply that
/// whoever walks it runs out of stack.
nlohmann::json parseJson(const Statement& row, int column, JsonIs is = JsonIs::Any);

/// Replaces what the store says about an experiment's names. Inside a transaction.
void writeDescriptions(sqlite3* database, int64_t experiment, const Descriptions& descriptions);
/// The rows as they are; none in a store of an older schema.
Descriptions readDescriptions(sqlite3* database, int64_t experiment);
/// The union of both; where they differ, `ours`.
Descriptions joinDescriptions(Descriptions ours, const Descriptions& theirs);

/// Makes view `runs` anew: a run that is done or failed a row, with a column for each parameter
/// ("technique.budget.rim") and each quantity ("rmse") that any experiment of the store names.
void writeRunView(sqlite3* database);

}  // namespace limen::store
