// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace limen::study {

/// Probability of a positive answer at which an up-down staircase settles (Levitt 1971, JASA 49, for
/// transformed ones; Kaernbach 1991, Perception and Psychophysics 49, for weighted ones): where a harder
/// step, after `down` positive answers in a row, balances an easier step, after `up` negative ones in a row.
/// With p positive and q = 1 - p the run of positives comes first with probability
///     A = p^(down-1) (1 - q^up) / (p^(down-1) + q^(up-1) - p^(down-1) q^(up-1)),
/// and A stepDown = (1 - A) stepUp. It is what an endless staircase with small steps tends to; with steps
/// that are large relative to the spread of the psychometric function staircases settle elsewhere
/// (Garcia-Perez 1998).
double convergenceProbability(int down, int up, double stepDown, double stepUp);

struct ReversalMean {
  double mean = 0.0, median = 0.0, low = 0.0, high = 0.0;
};

/// Mean and median of successive reversals, and a t interval of the mean at `level`. Mean and median are NaN
/// without a reversal, the interval with fewer than eight.
///
/// Successive reversals are correlated, so that intervals from single reversals or mid-runs are much too
/// short. This one comes from the means of four blocks of equal length (batch means; Conway 1963, Management
/// Science 10): the last multiple of eight reversals, as many peaks as valleys in each block, three degrees
/// of freedom. Blocks are not quite independent either. Share of 2000 simulated observers each whose targeted
/// stimulus was within a 95 % interval (cumulative normal with an SD of 1 to 4 steps, one up and one to three
/// down, guess rate 0 or 0.5 where that is below the target):
///     8 reversals 61 to 86 %,  16: 78 to 92 %,  32: 89 to 94 %,  64: 91 to 95 %
/// The shortfall at 64 is mostly bias: with guess rate 0.5 and steps as large as the SD one up, two down
/// settles 0.3 SD below its target.
ReversalMean meanOfReversals(const std::vector<double>& reversals, double level);

}  // namespace limen::study
