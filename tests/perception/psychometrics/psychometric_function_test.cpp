// SPDX-License-Identifier: BSD-3-Clause
#include "perception/psychometrics/psychometric_function.h"

#include <gtest/gtest.h>

#include <cmath>

namespace limen::psychometrics {
namespace {

TEST(PsychometricFunction, WatsonsFormIsItsFormula) {
  const auto f = PsychometricFunction::watson(-20, 3.5, 0.5, 0.02);
  for (double x = -40; x <= 0; x += 2.5) {
    const double expected = 1 - 0.02 - (1 - 0.5 - 0.02) * std::exp(-std::pow(10, 3.5 * (x + 20) / 20));
    EXPECT_NEAR(f.probability(x), expected, 1e-14);
    EXPECT_NEAR(f.complement(x), 1 - expected, 1e-14);
  }
}

TEST(PsychometricFunction, WatsonAndPellisFormIsItsFormula) {
  const auto f = PsychometricFunction::watsonPelli(-1.2, 3.5, 0.01, 0.5);
  for (double x = -3; x <= 1; x += 0.25) {
    const double expected = 0.01 * 0.5 + 0.99 * (1 - 0.5 * std::exp(-std::pow(10, 3.5 * (x + 1.2))));
    EXPECT_NEAR(f.probability(x), expected, 1e-14);
  }
}

TEST(PsychometricFunction, TasksSetTheAsymptotes) {
  const Sigmoid s = Sigmoid::normal(0, 1);
  const auto forced = PsychometricFunction::forcedChoice(s, 4, 0.03);
  EXPECT_NEAR(forced.probability(-40), 0.25, 1e-15);
  EXPECT_NEAR(forced.probability(40), 0.97, 1e-15);
  const auto equal = PsychometricFunction::equalAsymptotes(s, 0.04);
  EXPECT_NEAR(equal.probability(-40), 0.04, 1e-15);
  EXPECT_NEAR(equal.probability(0), 0.5, 1e-15);
  EXPECT_NEAR(equal.probability(40), 0.96, 1e-15);
  const auto yesNo = PsychometricFunction::yesNo(s, 0.1, 0.02);
  EXPECT_NEAR(yesNo.probability(0), 0.1 + 0.88 / 2, 1e-15);
  EXPECT_NEAR(yesNo.derivative(0), 0.88 * 0.3989422804014327, 1e-14);
}

TEST(PsychometricFunction, LogarithmsKeepTwelveDigitsWhereProbabilitiesVanish) {
  // With neither guesses nor lapses ln P = ln F: logistic, ln F(-800) = -800, which is 0 as a probability.
  const auto bare = PsychometricFunction::yesNo(Sigmoid::logistic(0, 1));
  EXPECT_NEAR(bare.logProbability(-800), -800, 1e-9);
  EXPECT_NEAR(bare.logComplement(800), -800, 1e-9);
  EXPECT_NEAR(bare.logProbability(50) / -std::exp(-50.0), 1, 1e-12);
  // The definitions in the wider type; erfc keeps both tails.
  for (double guess : {0.0, 1e-9, 0.5}) {
    for (double lapse : {0.0, 1e-12, 0.02}) {
      const auto f = PsychometricFunction::yesNo(Sigmoid::normal(0, 1), guess, lapse);
      for (double x : {-30.0, -8.0, -1.0, 0.0, 2.0, 8.0, 30.0}) {
        const long double root = std::sqrt(2.0L), range = 1.0L - guess - lapse;
        const long double p = guess + range * std::erfc(-x / root) / 2;
        const long double q = lapse + range * std::erfc(x / root) / 2;
        const long double logP = p < 0.5L ? std::log(p) : std::log1p(-q);
        const long double logQ = q < 0.5L ? std::log(q) : std::log1p(-p);
        EXPECT_NEAR(static_cast<double>(f.logProbability(x) / logP), 1, 1e-12) << guess << lapse << " " << x;
        EXPECT_NEAR(static_cast<double>(f.logComplement(x) / logQ), 1, 1e-12) << guess << lapse << " " << x;
      }
    }
  }
}

TEST(PsychometricFunction, InverseUndoesProbability) {
  const auto f = PsychometricFunction::forcedChoice(Sigmoid::weibull(0.3, 2.2), 2, 0.02);
  for (double p : {0.51, 0.75, 0.82, 0.97}) EXPECT_NEAR(f.probability(f.inverse(p)), p, 1e-13);
}

}  // namespace
}  // namespace limen::psychometrics
