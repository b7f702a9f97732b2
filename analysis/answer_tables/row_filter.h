// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "analysis/answer_tables/table.h"

namespace limen::analysis {

/// Rows in which every named column has its value: "counts=1". A column that is named several times may have
/// any of its values. Numbers are compared as numbers. Throws Error for text without '=', a column that is
/// not there, and if no row is left.
Table filterRows(const Table& table, const std::vector<std::string>& conditions,
                 const std::string& option = "--where");

}  // namespace limen::analysis
