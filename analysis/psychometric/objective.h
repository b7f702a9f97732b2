// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "analysis/psychometric/likelihood.h"
#include "analysis/psychometric/prior.h"

namespace limen::analysis {

/// One number that a fit varies: the parameter of a condition, or of all of them. A width is varied by its
/// logarithm; a threshold on the axis.
struct FreeParameter {
  FitParameter parameter;
  int condition;     ///< -1: all
  double low, high;  ///< bounds of what is varied
  double scale;      ///< a small change, for differences
  LevelSpread spread;
};

/// What a fit makes as small as possible: half the deviance (eta 0), or more generally logSaturated minus
/// log-likelihood, less the logarithm of the priors (MaximumPosterior).
class Objective {
 public:
  Objective(const std::vector<Condition>& conditions, const FitSettings& settings);

  size_t size() const { return free_.size(); }
  const std::vector<FreeParameter>& free() const { return free_; }
  size_t conditions() const { return blocks_.size(); }
  const PreparedBlocks& blocks(size_t condition) const { return blocks_[condition]; }
  const SigmoidShape& shape() const { return shape_; }
  const FitSettings& settings() const { return settings_; }
  const LevelSpread& spread(size_t condition) const { return spreads_[condition]; }
  /// Place of a parameter among the free ones, -1 if it is fixed or tied to another.
  int place(size_t condition, FitParameter parameter) const { return places_[condition][indexOf(parameter)]; }

  /// Infinite where the data or the parameters are impossible. `gradient`: size() numbers, or null.
  double evaluate(const double* x, double* gradient) const;

  AxisValues valuesOf(size_t condition, const double* x) const;
  /// ln of the priors' density at x, up to a constant; with `gradient`, its derivatives are taken off there.
  double logPriorAt(const double* x, double* gradient = nullptr) const;

 private:
  SigmoidShape shape_;
  FitSettings settings_;
  std::vector<PreparedBlocks> blocks_;
  std::vector<LevelSpread> spreads_;
  std::vector<FreeParameter> free_;
  std::vector<std::array<int, kFitParameters>> places_;
  AxisValues fixed_{};
};

/// Places of the parameters that condition `c` of one objective and `d` of another both vary.
std::vector<std::pair<size_t, size_t>> commonPlaces(const Objective& one, size_t c, const Objective& other,
                                                    size_t d);

}  // namespace limen::analysis
