// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "analysis/statistics/interval.h"

namespace limen::analysis {

/// Intervals of the means of conditions that every subject has seen, without what makes subjects differ in
/// all of them (Cousineau 2005, Tutorials in Quantitative Methods for Psychology 1): each subject's mean is
/// replaced by the grand mean, variances are then multiplied by c / (c - 1) of c conditions (Morey 2008, the
/// same journal, 4), and the interval is mean +- t_(n-1) sd / sqrt(n). They show how conditions differ within
/// subjects and say nothing of the mean itself.
///
/// `values`: by condition, then by subject; all the same number of subjects. None with fewer than two
/// subjects or conditions. `rates`: intervals are taken to the logit scale as meanRateOverSubjects() does,
/// none for a mean of 0 or 1.
std::vector<std::optional<Interval>> withinSubjectIntervals(const std::vector<std::vector<double>>& values,
                                                            bool rates = false, double level = 0.95);

}  // namespace limen::analysis
