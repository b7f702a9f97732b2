// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "analysis/statistics/interval.h"
#include "experiments/base/enum_names.h"

namespace limen::analysis {

/// Answers to "did you notice it?": signal trials are those with a change, noise trials those without.
struct YesNoCounts {
  int64_t hits = 0, signalTrials = 0;
  int64_t falseAlarms = 0, noiseTrials = 0;
};

enum class RateCorrection {
  kNone,      ///< rates as they are; 0 and 1 are refused, since d' would be infinite
  kLogLinear  ///< (k + 1/2) / (n + 1) for both rates, whatever they are (Hautus 1995)
};
constexpr EnumNames<RateCorrection, 2> enumNames(RateCorrection) {
  return {{{{RateCorrection::kLogLinear, "loglinear"}, {RateCorrection::kNone, "none"}}}};
}

/// Equal-variance Gaussian model (Green and Swets 1966; Macmillan and Creelman 2005, chapters 1, 2 and 13).
struct YesNoSensitivity {
  double hitRate = 0.0, falseAlarmRate = 0.0;  ///< after the correction
  double dPrime = 0.0;                         ///< z(H) - z(F)
  double criterion = 0.0;                      ///< c = -(z(H) + z(F)) / 2; above 0: reluctance to say yes
  double lnBeta = 0.0;                         ///< c d'
  double beta = 0.0;                           ///< likelihood ratio at the criterion
  double aPrime = 0.0;                         ///< see aPrime()
  /// Large-sample errors of Gourevitch and Galanter (1967): var z(p) = p (1 - p) / (n phi(z)^2), with the
  /// corrected rates and the true n; ln beta and A' by the delta method. Rough below about 20 trials, or with
  /// rates close to 0 or 1.
  double dPrimeError = 0.0, criterionError = 0.0, lnBetaError = 0.0, aPrimeError = 0.0;
  Interval dPrimeInterval, criterionInterval, lnBetaInterval;  ///< estimate +- z error
  Interval betaInterval;                                       ///< e to the bounds of ln beta
  Interval aPrimeInterval;                                     ///< estimate +- z error, clipped to [0, 1]
};

/// limen::Error for negative counts, more answers than trials, no trials, or a rate of 0 or 1 without
/// correction.
YesNoSensitivity analyseYesNo(const YesNoCounts& counts,
                              RateCorrection correction = RateCorrection::kLogLinear, double level = 0.95);

/// Nonparametric sensitivity A' (Pollack and Norman 1964; computed as in Snodgrass and Corwin 1988): 1/2 at
/// chance, 1 if perfect. Rates in [0, 1], limen::Error otherwise.
double aPrime(double hitRate, double falseAlarmRate);

/// Proportion correct of an unbiased observer who picks the largest of `alternatives` observations:
/// integral of phi(x - d') Phi(x)^(m-1) dx (Green and Swets 1966). By the trapezoidal rule, to a relative
/// error of 1e-12; the second form gives 1 minus that without cancellation. limen::Error unless d' is finite
/// with |d'| <= 60 and 2 <= m <= 1000.
double mAfcProportionCorrect(double dPrime, int alternatives);
double mAfcProportionWrong(double dPrime, int alternatives);

/// Inverse of mAfcProportionCorrect; negative below chance 1/m. limen::Error unless 0 < proportion < 1.
double mAfcDPrime(double proportionCorrect, int alternatives);

struct MAfcSensitivity {
  double proportionCorrect = 0.0;  ///< after the correction
  double dPrime = 0.0;
  double dPrimeError = 0.0;  ///< delta method: sqrt(p (1 - p) / n) / (dp/dd')
  /// Of d', from Wilson's interval of the uncorrected proportion; a side where that reaches 0 or 1 is open
  /// (none).
  std::optional<double> low, high;
};

/// limen::Error as above; with kNone for none or all correct too.
MAfcSensitivity analyseMAfc(int64_t correct, int64_t trials, int alternatives,
                            RateCorrection correction = RateCorrection::kLogLinear, double level = 0.95);

}  // namespace limen::analysis
