// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "analysis/statistics/interval.h"

namespace limen::analysis {

/// All take two lists of the same length, at least 2. limen::Error for lengths that differ (names the first
/// index without partner) and values that are not finite. A coefficient that a constant list leaves undefined
/// is none.

struct Coefficient {
  double value = 0.0;
  std::optional<double> standardError;  ///< none where n is too small for the method
  std::optional<Interval> interval;     ///< within -1 .. 1; none likewise
};

/// Kendall's rank correlation. P and Q count concordant and discordant pairs.
struct Kendall {
  size_t n = 0;
  int64_t concordant = 0, discordant = 0;
  int64_t tiedX = 0, tiedY = 0;  ///< pairs tied in x, in y; those tied in both count in both
  size_t distinctX = 0, distinctY = 0;
  /// (P - Q) / (n (n-1) / 2) (Kendall 1938); error of Samara and Randles (1988) as in Hollander, Wolfe and
  /// Chicken (2014, section 8.3), n >= 3.
  Coefficient tauA;
  /// (P - Q) / sqrt((pairs - tiedX) (pairs - tiedY)) (Kendall 1945); asymptotic error of Brown and Benedetti
  /// (1977).
  std::optional<Coefficient> tauB;
  /// Stuart (1953), m = min(distinctX, distinctY); asymptotic error of Brown and Benedetti (1977).
  std::optional<Coefficient> tauC;
  /// Two-sided, of independence; the same for all three. Exact without ties for n <= 50, else normal with the
  /// variance corrected for ties (Kendall 1970), without continuity correction. 1 if a list is constant.
  double p = 1.0;
  bool exact = false;
};

/// In O(n log n). Intervals are value +- z error, and of zero width where the sample leaves no spread
/// (perfect order): do not read certainty into those.
Kendall kendall(const std::vector<double>& x, const std::vector<double>& y, double level = 0.95);

/// Stuart's tau_c = 2 m (P - Q) / (n^2 (m - 1)) from the counts themselves. limen::Error unless n >= 2, 2 <=
/// m <= n and |P - Q| <= n (n - 1) / 2.
double stuartTauC(int64_t n, int64_t m, int64_t concordantMinusDiscordant);

struct Correlation {
  size_t n = 0;
  Coefficient coefficient;
  std::optional<double> p;  ///< two-sided, of no correlation; none for n < 3
  bool exact = false;
};

/// Product-moment correlation; p by t with n - 2 degrees, error and interval by Fisher's z (1921), error
/// 1/sqrt(n-3) on that scale and (1 - r^2)/sqrt(n-3) on r's, n >= 4. None if a list is constant.
std::optional<Correlation> pearson(const std::vector<double>& x, const std::vector<double>& y,
                                   double level = 0.95);

/// Pearson's of midranks. p exact over all orders for n <= 9 without ties, else by t with n - 2 degrees;
/// interval by Fisher's z with error sqrt((1 + r^2/2)/(n-3)) (Bonett and Wright 2000), n >= 4. None if a list
/// is constant.
std::optional<Correlation> spearman(const std::vector<double>& x, const std::vector<double>& y,
                                    double level = 0.95);

/// Correlation of a predictor with detection rates after Schwarz (2009, section 10.4.1): beyond the smallest
/// prediction that everybody detected, R_c = min{R : rate = 1}, larger ones cannot show, so R becomes min(R,
/// R_c).
struct ClampedPearson {
  std::optional<double> clamp;  ///< R_c; none if no rate is 1, nothing is clamped then
  size_t clamped = 0;           ///< values that were lowered
  std::optional<Correlation> correlation;
};

/// `rates` as fractions, within 1e-12 of 1 being 1; limen::Error also for one outside 0 .. 1.
ClampedPearson clampedPearson(const std::vector<double>& predictions, const std::vector<double>& rates,
                              double level = 0.95);

inline std::optional<double> valueOf(const std::optional<Coefficient>& coefficient) {
  return coefficient ? std::optional<double>(coefficient->value) : std::nullopt;
}
inline std::optional<double> valueOf(const std::optional<Correlation>& correlation) {
  return correlation ? std::optional<double>(correlation->coefficient.value) : std::nullopt;
}

}  // namespace limen::analysis
