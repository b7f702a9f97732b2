// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "analysis/observer_statistics/mixed.h"

namespace limen::analysis {

/// Rows of a table; every column can be an effect. Throws Error with row and column as the readers of columns
/// do, and for an empty group.
MixedRows readMixedRows(const Table& table, const std::string& group, const AnswerColumns& columns);

}  // namespace limen::analysis
