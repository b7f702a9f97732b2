// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace limen::analysis {

/// Friedman (1937): do k treatments, ranked by each of n subjects, differ? Values of a subject that agree up
/// to rounding (about 1e-15 of their largest) are ties.
struct FriedmanTest {
  size_t subjects = 0, treatments = 0;
  std::vector<double> meanRanks;  ///< of each treatment; 1 is smallest
  /// 12 sum (R_j - n(k+1)/2)^2 / (n k (k+1) - sum(t^3 - t)/(k-1)), corrected for ties; p by chi-squared, k -
  /// 1 degrees. None if every subject ties all treatments.
  std::optional<double> chiSquared, p;
  /// F form (Iman and Davenport 1980), less conservative: (n-1) chi2 / (n(k-1) - chi2) with k-1 and
  /// (k-1)(n-1) degrees; +infinity with p = 0 if all subjects agree perfectly.
  std::optional<double> f, fP;
  std::optional<double> kendallW;  ///< agreement, chi2 / (n (k-1)): 0 none, 1 perfect
};

/// `values` by subject, treatment varying fastest. limen::Error for fewer than 2 subjects or treatments, a
/// mismatched length, non-finite values.
FriedmanTest friedmanTest(const std::vector<double>& values, size_t subjects, size_t treatments);

/// Wilcoxon (1945) signed ranks of paired differences first - second. Differences that agree up to rounding
/// (about 1e-15 of the largest value) are ties; R would break those.
struct SignedRankTest {
  size_t pairs = 0;                                 ///< that differ
  size_t zeros = 0;                                 ///< dropped pairs
  double positiveRanks = 0.0, negativeRanks = 0.0;  ///< sums; V = W+ is the first
  /// Two-sided. Exact without ties and zeros for up to 50 pairs; otherwise normal, with tie and continuity
  /// correction, as in R. 1 if no pair differs.
  double p = 1.0;
  bool exact = false;
  double rankBiserial = 0.0;  ///< (W+ - W-) / (W+ + W-) (Kerby 2014); 0 if no pair differs
};

/// limen::Error for lists that differ in length, are empty, or hold values that are not finite.
SignedRankTest signedRankTest(const std::vector<double>& first, const std::vector<double>& second);

}  // namespace limen::analysis
