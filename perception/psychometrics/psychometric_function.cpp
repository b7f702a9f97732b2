// SPDX-License-Identifier: BSD-3-Clause
#include "perception/psychometrics/psychometric_function.h"

#include <cassert>
#include <cmath>

namespace limen::psychometrics {

PsychometricFunction::PsychometricFunction(const Sigmoid& sigmoid, double guess, double lapse)
    : sigmoid_(sigmoid), guess_(guess), lapse_(lapse) {
  assert(guess >= 0.0 && lapse >= 0.0 && guess + lapse < 1.0);
}

PsychometricFunction PsychometricFunction::yesNo(const Sigmoid& sigmoid, double guess, double lapse) {
  return {sigmoid, guess, lapse};
}

PsychometricFunction PsychometricFunction::forcedChoice(const Sigmoid& sigmoid, int alternatives,
                                                        double lapse) {
  assert(alternatives >= 2);
  return {sigmoid, 1.0 / alternatives, lapse};
}

PsychometricFunction PsychometricFunction::equalAsymptotes(const Sigmoid& sigmoid, double lapse) {
  return {sigmoid, lapse, lapse};
}

PsychometricFunction PsychometricFunction::watson(double thresholdDb, double slope, double guess,
                                                  double lapse) {
  return {Sigmoid::weibullDecibel(thresholdDb, slope), guess, lapse};
}

PsychometricFunction PsychometricFunction::watsonPelli(double threshold, double beta, double delta,
                                                       double gamma) {
  return {Sigmoid::weibullLog10(threshold, beta), gamma, delta * (1.0 - gamma)};
}

// Sums of non-negative terms: no cancellation.
double PsychometricFunction::probability(double x) const {
  return guess_ + (1.0 - guess_ - lapse_) * sigmoid_.value(x);
}

double PsychometricFunction::complement(double x) const {
  return lapse_ + (1.0 - guess_ - lapse_) * sigmoid_.complement(x);
}

double PsychometricFunction::logProbability(double x) const {
  if (guess_ == 0.0) return std::log1p(-lapse_) + sigmoid_.logValue(x);
  const double p = probability(x);
  return p < 0.5 ? std::log(p) : std::log1p(-complement(x));
}

double PsychometricFunction::logComplement(double x) const {
  if (lapse_ == 0.0) return std::log1p(-guess_) + sigmoid_.logComplement(x);
  const double q = complement(x);
  return q < 0.5 ? std::log(q) : std::log1p(-probability(x));
}

double PsychometricFunction::derivative(double x) const {
  return (1.0 - guess_ - lapse_) * sigmoid_.derivative(x);
}

double PsychometricFunction::inverse(double p) const {
  assert(p > guess_ && p < 1.0 - lapse_);
  const double range = 1.0 - guess_ - lapse_;
  const double f = (p - guess_) / range;
  return f <= 0.5 ? sigmoid_.inverse(f) : sigmoid_.inverseComplement((1.0 - lapse_ - p) / range);
}

}  // namespace limen::psychometrics
