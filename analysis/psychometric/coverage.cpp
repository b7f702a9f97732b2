// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/psychometric/coverage.h"

#include <fmt/format.h>

#include <algorithm>

namespace limen::analysis {
namespace {

/// Counted by tests/analysis/psychometric/fit_coverage.cpp: experiments of 5 levels x 40 trials, two
/// alternatives, cumulative Gaussian, levels at F = 0.1, 0.3, 0.5, 0.8 and 0.98, lapse rate 0.02 and fitted;
/// maximum likelihood; 300 bootstrap samples an interval. Laplace gives no interval in some of the
/// experiments.
struct Measured {
  IntervalMethod method;
  bool parametric;
  FitParameter parameter;
  int held, experiments;
};
constexpr Measured kMeasured[] = {
    {IntervalMethod::Bootstrap, true, FitParameter::Threshold, 913, 1000},
    {IntervalMethod::Bootstrap, true, FitParameter::Width, 878, 1000},
    {IntervalMethod::Bootstrap, true, FitParameter::Lapse, 964, 1000},
    {IntervalMethod::Bootstrap, false, FitParameter::Threshold, 938, 1000},
    {IntervalMethod::Bootstrap, false, FitParameter::Width, 909, 1000},
    {IntervalMethod::Bootstrap, false, FitParameter::Lapse, 781, 1000},
    {IntervalMethod::Profile, true, FitParameter::Threshold, 936, 1000},
    {IntervalMethod::Profile, true, FitParameter::Width, 931, 1000},
    {IntervalMethod::Profile, true, FitParameter::Lapse, 975, 1000},
    {IntervalMethod::Laplace, true, FitParameter::Threshold, 918, 996},
    {IntervalMethod::Laplace, true, FitParameter::Width, 928, 994},
    {IntervalMethod::Laplace, true, FitParameter::Lapse, 529, 540},
    {IntervalMethod::Bca, true, FitParameter::Threshold, 886, 1000},
    {IntervalMethod::Bca, true, FitParameter::Width, 899, 1000},
    {IntervalMethod::Bca, true, FitParameter::Lapse, 903, 1000},
    {IntervalMethod::Posterior, true, FitParameter::Threshold, 944, 1000},
    {IntervalMethod::Posterior, true, FitParameter::Width, 988, 1000},
    {IntervalMethod::Posterior, true, FitParameter::Lapse, 998, 1000},
};

}  // namespace

std::vector<std::string> coverageNotes(IntervalMethod method, bool parametric) {
  std::vector<std::string> notes;
  const bool drawn = method == IntervalMethod::Bootstrap || method == IntervalMethod::Bca;
  bool known = false;
  for (const Measured& row : kMeasured) {
    if (row.method != method || (drawn && row.parametric != parametric)) continue;
    known = true;
    const double percent = 100.0 * row.held / row.experiments;
    if (percent >= 93.0 && percent <= 97.0) continue;
    notes.push_back(fmt::format(
        "95 % intervals of the {} held the true value in {:.1f} % of {} simulated experiments (5 levels "
        "x 40 trials, 2afc, lapse rate fitted)",
        fitParameterNames()[indexOf(row.parameter)], percent, row.experiments));
  }
  if (!known) notes.push_back("how often these intervals hold the true value was not measured");
  if (method == IntervalMethod::Posterior)
    notes.push_back("equal tails: the interval of a rate never reaches 0, however small it may be");
  return notes;
}

}  // namespace limen::analysis
