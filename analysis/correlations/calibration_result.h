// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "analysis/output/result.h"
#include "analysis/statistics/roc.h"

namespace limen::analysis {

/// Tables "calibration", the terms of the Brier score, and "bins", of probabilities in column `x`.
void addCalibration(Section& out, const Calibration& calibration, const std::string& x,
                    const std::string& level);

}  // namespace limen::analysis
