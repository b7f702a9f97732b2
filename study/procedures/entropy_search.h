// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "perception/psychometrics/grid_posterior.h"
#include "study/procedures/model_settings.h"

namespace limen::study {

/// Expected entropy of the posterior after a trial with each stimulus of a grid (Kontsevich and Tyler 1999,
/// Vision Research 39; Watson 2017), from tables made once. With parameters marked as nuisance it is the
/// entropy after marginalising these out (Prins 2013, Journal of Vision 13(7):3).
///
/// No posterior is formed. With Z_o = sum_i p_i L_oi, the probability of outcome o,
///     E[H] = H(p) + sum_o Z_o ln Z_o + sum_i p_i h_i,   h_i = -sum_o L_oi ln L_oi,
/// where h, the entropy of the answer at parameter point i, is a table; and with nuisance parameters, m_oj
/// being the sum of p_i L_oi over the points that share the point j of interest,
///     E[H] = sum_o (Z_o ln Z_o - sum_j m_oj ln m_oj).
class EntropySearch {
 public:
  /// Time and memory are proportional to stimuli, points and outcomes. Throws Error if memory exceeds 1 GiB.
  explicit EntropySearch(const ModelSettings& settings, const std::string& where = {});

  size_t stimuli() const { return grid_.size(); }
  const psychometrics::ProductGrid& stimulusGrid() const { return grid_; }
  /// Expected entropy in nats for each stimulus, in the order of the grid.
  std::vector<double> expectedEntropies(const psychometrics::GridPosterior& posterior) const;

 private:
  double withNuisance(const double* likelihood, const std::vector<double>& probability) const;

  psychometrics::ProductGrid grid_;
  size_t points_, outcomes_;
  std::vector<double> likelihood_;     // [stimulus][outcome][point]
  std::vector<double> answerEntropy_;  // [stimulus][point]; empty with nuisance parameters
  std::vector<size_t> ofInterest_;     // [point] = number of the point of interest; empty without nuisance
  size_t interestPoints_ = 0;
};

/// How much an expected entropy may exceed the lowest, relative to it (plus a hundredth of a nat), and still
/// count as equal.
inline constexpr double kTieTolerance = 1e-12;

/// The stimulus with the lowest expected entropy; of those that count as equal the first in the order of the
/// grid. So rounding, which differs between machines, does not decide between equally good stimuli.
size_t lowestEntropy(const std::vector<double>& entropies, double tolerance = kTieTolerance);
/// The `count` lowest in ascending order, found one after the other by the same rule.
std::vector<size_t> lowestEntropies(const std::vector<double>& entropies, size_t count,
                                    double tolerance = kTieTolerance);

}  // namespace limen::study
