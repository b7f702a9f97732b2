// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "analysis/psychometric/intervals.h"

namespace limen::analysis {

/// What is known of how often 95 % intervals of a method held the true value in simulated experiments, for
/// those where that was outside of 93 to 97 %; empty where it was not. Of experiments with the same task, or
/// with two alternatives where that was not simulated. The table in coverage.cpp says what was.
std::vector<std::string> coverageNotes(IntervalMethod method, bool parametric, const FitTask& task);

}  // namespace limen::analysis
