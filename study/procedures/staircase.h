// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace limen::study {

/// Probability of a positive answer at which an up-down staircase settles (Levitt 1971, JASA 49, for
/// transformed ones; Kaernbach 1991, Perception and Psychophysics 49, for weighted ones): where a step to
/// harder, after `down` positive answers in a row, balances a step to easier, after `up` negative ones in a
/// row. With p positive and q = 1 - p the run of positives comes first with probability
///     A = p^(down-1) (1 - q^up) / (p^(down-1) + q^(up-1) - p^(down-1) q^(up-1)),
/// and A stepDown = (1 - A) stepUp. It is what an endless staircase of small steps tends to; with steps that
/// are large against the spread of the psychometric function staircases settle elsewhere (Garcia-Perez 1998).
///
/// Coverage of the 95 % t interval of `staircase` estimates, measured over 2000 simulated observers each
/// (cumulative normal of SD 4 steps, threshold drawn evenly over one step): see the manual text of
/// describeProcedures().
double convergenceProbability(int down, int up, double stepDown, double stepUp);

struct ReversalMean {
  double mean = 0.0, median = 0.0, low = 0.0, high = 0.0;
  int midRuns = 0;
};

/// Mean of an even number of successive reversals and its t interval at `level`, from the middles between
/// each peak and its valley (mid-runs; Wetherill and Levitt 1965) taken for independent. NaN where there are
/// too few.
ReversalMean meanOfReversals(const std::vector<double>& reversals, double level);

}  // namespace limen::study
