// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "analysis/psychometric/intervals.h"

namespace limen::analysis {

/// How often a method's 95 % intervals contained the true value in simulated experiments, if that was outside
/// 93 to 97 %; empty otherwise. From experiments with the same task, or with two alternatives if that was not
/// simulated. The table in coverage.cpp lists what was simulated.
std::vector<std::string> coverageNotes(IntervalMethod method, bool parametric, const FitTask& task);

}  // namespace limen::analysis
