// SPDX-License-Identifier: BSD-3-Clause
#include "study/observers/decision.h"

#include <gtest/gtest.h>

#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <numbers>

#include "tests/study/observers/binomial.h"

namespace limen::study {
namespace {

using psychometrics::Random;

// Boost's, not ours.
double phi(double z) { return boost::math::cdf(boost::math::normal(), z); }
double phiInverse(double p) { return boost::math::quantile(boost::math::normal(), p); }

DecisionSetting settingOf(DetectionTheory theory, double detected, double guess, double lapse) {
  DecisionSetting out;
  out.theory = theory;
  out.detected = detected;
  out.guess = guess;
  out.lapse = lapse;
  return out;
}

constexpr DetectionTheory kTheories[] = {DetectionTheory::HighThreshold, DetectionTheory::SignalDetection};

int countYes(const DecisionSetting& setting, int trials, uint64_t seed) {
  Random random(seed);
  int yes = 0;
  for (int i = 0; i < trials; ++i) yes += decideYesNo(setting, random).choice;
  return yes;
}

int countCorrect(const DecisionSetting& setting, int m, int target, int trials, uint64_t seed) {
  Random random(seed);
  int correct = 0;
  for (int i = 0; i < trials; ++i) correct += decideAlternative(setting, m, target, random).choice == target;
  return correct;
}

TEST(Decision, YesIsAsFrequentAsThePsychometricFunctionSays) {
  // guess + (1 - guess - lapse) F: 0.05 + 0.92 * 0.4 = 0.418; catch trials: the guess rate.
  for (const DetectionTheory theory : kTheories) {
    const DecisionSetting change = settingOf(theory, 0.4, 0.05, 0.03);
    EXPECT_NEAR(yesProbability(change), 0.418, 1e-12);
    EXPECT_TRUE(isRate(countYes(change, 20000, 1), 20000, 0.418));
    EXPECT_TRUE(isRate(countYes(settingOf(theory, 0.0, 0.05, 0.03), 20000, 2), 20000, 0.05));
    EXPECT_TRUE(isRate(countYes(settingOf(theory, 1.0, 0.05, 0.03), 20000, 3), 20000, 0.97));
  }
}

TEST(Decision, CriterionShiftMovesHitsAndFalseAlarmsAsSignalDetectionSays) {
  DecisionSetting setting = settingOf(DetectionTheory::SignalDetection, 0.5, 0.1, 0.0);
  setting.criterionShift = 0.7;
  // Unbiased: H = 0.1 + 0.9 * 0.5 = 0.55, so that d' = z(0.55) - z(0.1) and the criterion is -z(0.1) + 0.7.
  const double sensitivity = phiInverse(0.55) - phiInverse(0.1), criterion = 0.7 - phiInverse(0.1);
  const double hits = phi(sensitivity - criterion), alarms = phi(-criterion);
  EXPECT_NEAR(yesProbability(setting), hits, 1e-9);
  EXPECT_TRUE(isRate(countYes(setting, 20000, 4), 20000, hits));
  setting.detected = 0.0;
  EXPECT_NEAR(yesProbability(setting), alarms, 1e-9);
  EXPECT_TRUE(isRate(countYes(setting, 20000, 5), 20000, alarms));
  // The sensitivity that an experimenter computes from these rates is the unbiased one.
  EXPECT_NEAR(phiInverse(hits) - phiInverse(alarms), sensitivity, 1e-9);
}

TEST(Decision, UnderHighThresholdACriterionMovesGuessesAlone) {
  DecisionSetting setting = settingOf(DetectionTheory::HighThreshold, 0.5, 0.1, 0.0);
  setting.criterionShift = -1.0;
  const double guess = phi(phiInverse(0.1) + 1.0);
  EXPECT_NEAR(yesProbability(setting), 0.5 + 0.5 * guess, 1e-9);
  EXPECT_TRUE(isRate(countYes(setting, 20000, 6), 20000, 0.5 + 0.5 * guess));
}

TEST(Decision, AlternativesAreRightAsOftenAsThePsychometricFunctionSays) {
  for (const DetectionTheory theory : kTheories)
    for (const int m : {2, 3, 4}) {
      const double chance = 1.0 / m, expected = chance + (1.0 - chance - 0.04) * 0.6;
      const DecisionSetting setting = settingOf(theory, 0.6, 0.0, 0.04);
      EXPECT_NEAR(correctProbability(setting, m, m - 1), expected, 1e-8);
      const int trials = m > 2 ? 2000 : 10000;
      EXPECT_TRUE(isRate(countCorrect(setting, m, m - 1, trials, 7), trials, expected));
    }
}

TEST(Decision, LikingTheFirstOfTwoShiftsBothRatesAsSignalDetectionSays) {
  DecisionSetting setting = settingOf(DetectionTheory::SignalDetection, 0.6, 0.0, 0.0);
  setting.firstBias = 0.5;
  // Unbiased 0.5 + 0.5 * 0.6 = 0.8 = Phi(d' / sqrt 2) (Macmillan and Creelman 2005, chapter 7).
  const double sensitivity = std::numbers::sqrt2 * phiInverse(0.8);
  const double first = phi((sensitivity + 0.5) / std::numbers::sqrt2);
  const double second = phi((sensitivity - 0.5) / std::numbers::sqrt2);
  EXPECT_NEAR(correctProbability(setting, 2, 0), first, 1e-9);
  EXPECT_NEAR(correctProbability(setting, 2, 1), second, 1e-9);
  EXPECT_TRUE(isRate(countCorrect(setting, 2, 0, 20000, 8), 20000, first));
  EXPECT_TRUE(isRate(countCorrect(setting, 2, 1, 20000, 9), 20000, second));
}

TEST(Decision, SensitivityMakesAnObserverRightAsOftenAsAsked) {
  EXPECT_NEAR(sensitivityOf(0.75, 2), std::numbers::sqrt2 * phiInverse(0.75), 1e-9);
  // The largest of m plain draws, without the decision's own code.
  Random random(10);
  for (const int m : {3, 5}) {
    const double sensitivity = sensitivityOf(0.7, m);
    int largest = 0;
    constexpr int kTrials = 40000;
    for (int i = 0; i < kTrials; ++i) {
      const double own = sensitivity + random.normal();
      bool isLargest = true;
      for (int j = 1; j < m; ++j) isLargest &= random.normal() < own;
      largest += isLargest;
    }
    EXPECT_TRUE(isRate(largest, kTrials, 0.7));
  }
}

TEST(Decision, PairsFollowThurstonesCaseV) {
  DecisionSetting setting;
  Random random(11);
  int second = 0;
  for (int i = 0; i < 20000; ++i) second += decidePair(setting, 0.3, 1.1, random).choice;
  const double expected = phi(0.8 / std::numbers::sqrt2);
  EXPECT_NEAR(secondProbability(setting, 0.3, 1.1), expected, 1e-9);
  EXPECT_TRUE(isRate(second, 20000, expected));
}

TEST(Decision, EvidenceOfYesIsNeverBelowTheCriterion) {
  for (const DetectionTheory theory : kTheories) {
    Random random(12);
    for (int i = 0; i < 5000; ++i) {
      const Judgement judgement = decideYesNo(settingOf(theory, 0.3, 0.2, 0.1), random);
      EXPECT_EQ(judgement.choice == 1, judgement.evidence >= 0.0);
    }
  }
}

TEST(Decision, ExtremesStayFinite) {
  for (const DetectionTheory theory : kTheories) {
    EXPECT_NEAR(yesProbability(settingOf(theory, 1.0, 0.01, 0.0)), 1.0, 1e-9);
    EXPECT_NEAR(correctProbability(settingOf(theory, 1.0, 0.0, 0.0), 4, 2), 1.0, 1e-9);
    EXPECT_NEAR(correctProbability(settingOf(theory, 0.0, 0.0, 0.0), 4, 2), 0.25, 1e-9);
    DecisionSetting biased = settingOf(theory, 1.0, 0.01, 0.0);
    biased.criterionShift = 10.0;
    EXPECT_TRUE(std::isfinite(yesProbability(biased)));
  }
}

TEST(Decision, StepsCountTheBoundsReached) {
  const std::vector<double> bounds = {0.0, 1.0, 2.5};
  EXPECT_EQ(stepOf(-INFINITY, bounds), 1);
  EXPECT_EQ(stepOf(-0.001, bounds), 1);
  EXPECT_EQ(stepOf(0.0, bounds), 2);
  EXPECT_EQ(stepOf(2.5, bounds), 4);
}

}  // namespace
}  // namespace limen::study
