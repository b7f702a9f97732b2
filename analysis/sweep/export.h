// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "analysis/sweep/sweep.h"

namespace limen::analysis {

/// Writes runs.csv (one row a run: parameters and measurements), measurements.csv (long form),
/// frame_times.csv and passes.csv into `folder`, and beside them what their names mean: quantities.csv and
/// parameters.csv. Full precision; an absent value is an empty field. Failed
/// runs are in runs.csv.
void exportTables(const Sweep& sweep, const std::string& folder);

}  // namespace limen::analysis
