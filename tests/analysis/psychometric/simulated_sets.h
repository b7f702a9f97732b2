// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <vector>

#include "analysis/psychometric/fit.h"
#include "analysis/psychometric/intervals.h"

namespace limen::analysis {

Condition classicSet();  ///< 13 levels of 90 trials, two alternatives: psignifit 4's example

/// An observer and an experiment of 5 levels x 40 trials.
struct CoverageExperiment {
  FitSettings settings;
  std::array<double, kFitParameters> truth;
  std::vector<double> levels;
  int64_t trials = 40;
};
/// Cumulative Gaussian with threshold 0 and width 2, levels at F = 0.1 ... 0.98, lapse rate 0.02 and free;
/// "2afc", "mafc:M" or "yesno" (false alarms 0.05 and free).
CoverageExperiment coverageExperiment(const std::string& task);

/// Answers drawn with childSeed(7, "set INDEX").
Condition drawSet(const CoverageExperiment& experiment, int index);

struct CoverageCount {
  std::array<int, kFitQuantities> held{}, given{};
};
/// Of each method, over the sets from `first` on. `methods`: names of IntervalMethod or
/// "nonparametric" (percentiles). "bootstrap" and "bca" are of the same samples.
std::vector<CoverageCount> countCoverage(const CoverageExperiment& experiment,
                                         const std::vector<std::string>& methods, int first, int sets,
                                         size_t samples);

}  // namespace limen::analysis
