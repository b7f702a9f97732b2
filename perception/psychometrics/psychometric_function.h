// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "perception/psychometrics/sigmoid.h"

namespace limen::psychometrics {

/// Probability of a positive (yes, correct) answer to stimulus x: P(x) = guess + (1 - guess - lapse) F(x), so
/// that P rises from `guess` to 1 - `lapse` (Wichmann and Hill 2001, Perception and Psychophysics 63). Both
/// are at least 0 and sum to less than 1.
class PsychometricFunction {
 public:
  PsychometricFunction(const Sigmoid& sigmoid, double guess, double lapse);

  /// Yes/no task: `guess` is the rate of false alarms.
  static PsychometricFunction yesNo(const Sigmoid& sigmoid, double guess = 0.0, double lapse = 0.0);
  /// Forced choice among `alternatives` >= 2: the guess rate is 1 / alternatives.
  static PsychometricFunction forcedChoice(const Sigmoid& sigmoid, int alternatives, double lapse = 0.0);
  /// Lower and upper asymptote at the same distance from 0 and 1, for symmetric tasks such as left or right.
  static PsychometricFunction equalAsymptotes(const Sigmoid& sigmoid, double lapse);
  /// Watson (2017): 1 - lapse - (1 - guess - lapse) exp(-10^(slope (x - threshold) / 20)), x in decibels.
  static PsychometricFunction watson(double thresholdDb, double slope, double guess, double lapse);
  /// Watson and Pelli (1983) as Pelli's QuestCreate states it: delta gamma + (1 - delta) (1 - (1 - gamma)
  /// exp(-10^(beta (x - threshold)))), x in log10 units. An observer who lapses (delta) guesses (gamma), so
  /// that the lapse rate of the form above is delta (1 - gamma).
  static PsychometricFunction watsonPelli(double threshold, double beta, double delta, double gamma);

  double probability(double x) const;     ///< P
  double complement(double x) const;      ///< 1 - P, without cancellation
  double logProbability(double x) const;  ///< ln P
  double logComplement(double x) const;   ///< ln(1 - P)
  double derivative(double x) const;      ///< dP/dx
  /// The x with P(x) = p, guess < p < 1 - lapse.
  double inverse(double p) const;

  const Sigmoid& sigmoid() const { return sigmoid_; }
  double guess() const { return guess_; }
  double lapse() const { return lapse_; }

 private:
  Sigmoid sigmoid_;
  double guess_, lapse_;
};

}  // namespace limen::psychometrics
