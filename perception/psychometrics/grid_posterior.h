// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "perception/psychometrics/grid.h"

namespace limen::psychometrics {

/// Prior of one parameter: probabilities of the axis's values, which sum to 1.
/// `json` is "uniform", {normal: {mean, sd}}, {beta: {a, b}} (on values from 0 to 1) or a list of weights,
/// one per value. A density is evaluated at the values of the axis, as in Watson (2017), and normalised over
/// them. Throws Error that names `where`.
std::vector<double> readPrior(const nlohmann::json& json, const GridAxis& axis, const std::string& where);
std::vector<double> uniformPrior(const GridAxis& axis);

struct CredibleInterval {
  double low = 0.0, high = 0.0;
};

/// Posterior over the points of a product grid. Sums run in the order of the points, so that the same answers
/// give the same bits.
///
/// Statements about a single parameter treat its marginal as a histogram: every value of the axis represents
/// the interval up to the midpoints between it and its neighbours (geometric midpoints on logarithmic axes;
/// at the ends of the axis as far outwards as inwards), over which its probability is spread evenly.
/// Quantiles and intervals are those of the histogram, clipped to the axis's first and last value. Their
/// meaning: given the model, the prior and the answers, the parameter lies within with the stated
/// probability. For parameters drawn from the prior they contain the true value that often; for a fixed
/// observer far from the prior they need not. An interval that ends at the end of the axis shows that the
/// axis was too short.
class GridPosterior {
 public:
  /// `priors`: one list per dimension; the joint prior is their product.
  GridPosterior(std::vector<GridAxis> axes, const std::vector<std::vector<double>>& priors);

  const ProductGrid& grid() const { return grid_; }
  size_t size() const { return probability_.size(); }

  /// Multiplies with the likelihood of an answer, given as its logarithm at each of size() points, and
  /// normalises. False, and nothing changed, if the answer is impossible at every remaining point.
  [[nodiscard]] bool update(const double* logLikelihood);

  /// Of each point; sums to 1.
  const std::vector<double>& probability() const { return probability_; }
  /// ln of the same plus a constant; keeps points whose probability has become too small for a number.
  const std::vector<double>& logWeight() const { return logWeight_; }

  double entropy() const;    ///< in nats: -sum p ln p
  size_t modePoint() const;  ///< the most probable point; the first if tied

  std::vector<double> marginal(size_t dimension) const;
  double mean(size_t dimension) const;
  double standardDeviation(size_t dimension) const;
  double mode(size_t dimension) const;  ///< of the marginal; the first if tied
  double median(size_t dimension) const { return quantile(dimension, 0.5); }
  double quantile(size_t dimension, double p) const;
  /// The median: as much probability below as above.
  CredibleInterval equalTailed(size_t dimension, double level) const;
  /// The shortest interval with probability `level`: the highest-density interval if the marginal has one
  /// peak.
  CredibleInterval highestDensity(size_t dimension, double level) const;

  /// SHA-256 of the bytes of logWeight(), from which everything else follows: equal for the same posterior,
  /// bit for bit.
  std::string hash() const;

 private:
  void normalise();

  ProductGrid grid_;
  std::vector<double> logWeight_, probability_;
};

}  // namespace limen::psychometrics
