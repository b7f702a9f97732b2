// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "experiments/base/enum_names.h"

namespace limen::analysis {

/// Scales from "which of the two?" judgements.
enum class PairwiseModel {
  /// P(i over j) = Phi(s_i - s_j) (Thurstone 1927, case V); the unit is the standard deviation of the
  /// difference of two impressions, so that 0.674 is preferred in 75 % of judgements. Unweighted least
  /// squares
  /// of Phi^-1 of the observed proportions (Mosteller 1951), over the pairs that were judged.
  kThurstoneLeastSquares,
  kThurstoneMaximumLikelihood,  ///< the same model, by maximum likelihood
  kBradleyTerry  ///< P(i over j) = 1 / (1 + exp(s_j - s_i)) (Bradley and Terry 1952), maximum likelihood
};

constexpr EnumNames<PairwiseModel, 3> enumNames(PairwiseModel) {
  return {{{{PairwiseModel::kBradleyTerry, "bradley-terry"},
            {PairwiseModel::kThurstoneMaximumLikelihood, "thurstone"},
            {PairwiseModel::kThurstoneLeastSquares, "thurstone-ls"}}}};
}

/// What to do if the data put an item infinitely far away: no chain of preferences leads from each item to
/// each other (Ford 1957); for least squares, any pair judged unanimously.
enum class UnboundedScale {
  kRefuse,   ///< limen::Error that names items
  kPenalise  ///< a bounded answer, marked as such, which depends on the penalty
};
constexpr EnumNames<UnboundedScale, 2> enumNames(UnboundedScale) {
  return {{{{UnboundedScale::kRefuse, "refuse"}, {UnboundedScale::kPenalise, "penalise"}}}};
}

struct PairwiseOptions {
  PairwiseModel model = PairwiseModel::kBradleyTerry;
  UnboundedScale unbounded = UnboundedScale::kRefuse;
  /// Maximum likelihood is penalised as by a normal prior of this standard deviation on each scale value.
  /// Least squares uses (k + 1/2) / (n + 1) for every pair instead.
  double priorDeviation = 2.0;
  int resamples = 0;  ///< of the bootstrap; 0 for none
  uint64_t seed = 1;
  std::vector<std::string> names;  ///< of the items, for messages; empty: their indices from 0
};

struct PairwiseScale {
  std::vector<double> values;  ///< sum to 0
  /// From the inverse Hessian under that constraint; of least squares by the delta method.
  std::vector<double> standardErrors;
  std::vector<double> covariance;  ///< items x items, rows; for errors of differences
  /// For each resample, which redraws every pair's judgements from its observed proportion, the values of all
  /// items. Same seed, same bytes.
  std::vector<std::vector<double>> bootstrapValues;
  int penalisedResamples = 0;  ///< resamples that were unbounded, and penalised regardless of `unbounded`

  double logLikelihood = 0.0;  ///< of the judgements in their order, without binomial coefficients or penalty
  /// Against one free proportion per pair: likelihood ratio G^2 and Pearson's X^2, `df` = pairs judged -
  /// (items
  /// - 1). p values are chi-squared; none for df 0 or a penalised scale.
  double deviance = 0.0, pearson = 0.0;
  size_t pairsJudged = 0;
  size_t df = 0;
  std::optional<double> devianceP, pearsonP;
  bool penalised = false;
  std::string note;  ///< a message to that effect; empty otherwise
};

/// `wins` by row: wins[i * items + j] is how often item i was chosen over j. limen::Error for fewer than 2
/// items, a mismatched size, negative counts, counts on the diagonal (names the entry), a design that
/// falls into parts that were never compared with each other (names an item of each), and as `UnboundedScale`
/// says. There are no ties.
PairwiseScale scalePairs(const std::vector<int64_t>& wins, size_t items, const PairwiseOptions& options = {});

/// Proportion that the scale predicts for `difference` = s_i - s_j.
double predictPreference(PairwiseModel model, double difference);

}  // namespace limen::analysis
