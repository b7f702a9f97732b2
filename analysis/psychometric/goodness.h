// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "analysis/psychometric/bootstrap.h"
#include "analysis/psychometric/fit.h"

namespace limen::analysis {

/// A statistic of the data with its distribution over data sets drawn from the fit and refitted.
struct MonteCarloTest {
  double value = 0.0;
  double low = 0.0,
         high = 0.0;  ///< 95 % of the drawn ones lie between these; a deviance has only the upper one
  /// (1 + number as extreme) / (1 + number drawn): of a deviance at least as large, of a correlation at
  /// least as far from 0.
  double p = 1.0;
};

/// How far the fit moves without one block.
struct BlockInfluence {
  double level = 0.0;
  double threshold = 0.0, width = 0.0;  ///< estimates without the block
  bool refused = false;                 ///< without the block there is no fit
  bool influential = false;  ///< threshold or width leave the 95 % interval of the parametric bootstrap
};

struct Goodness {
  MonteCarloTest deviance, withPrediction, withOrder;
  Residuals residuals;
  std::vector<BlockInfluence> influences;
};

/// Of each condition (Wichmann and Hill 2001, Perception and Psychophysics 63, 1293-1313). `replicates` come
/// from the parametric bootstrap.
std::vector<Goodness> goodnessOfFit(const std::vector<Condition>& conditions, const Fit& fit,
                                    const std::vector<Replicate>& replicates);

}  // namespace limen::analysis
