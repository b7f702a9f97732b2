// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "perception/psychometrics/random.h"
#include "study/observers/simulation.h"

namespace limen::study {

/// What an observer brings to a decision.
struct DecisionSetting {
  DetectionTheory theory = DetectionTheory::HighThreshold;
  double detected = 0.0;        ///< F: 0 where nothing changes
  double guess = 0.0;           ///< YesNo and Rating: rate of "yes" without a change, 0 <= guess < 1
  double lapse = 0.0;           ///< P ends at 1 - lapse; guess + lapse < 1 (1/m + lapse < 1)
  double criterionShift = 0.0;  ///< in SD of the noise; positive: more reluctant to say "yes"
  double firstBias = 0.0;       ///< preference for the first (left) alternative, in SD of the noise
};

/// A decision, with what led to it.
struct Judgement {
  int choice = 0;  ///< 1 "yes", 0 "no"; or the chosen alternative
  /// In SD of the noise above the criterion (yes/no), or by how much the chosen alternative was ahead.
  /// -infinity: nothing was seen (high threshold), or the observer lapsed.
  double evidence = 0.0;
  bool lapsed = false;
  double probability =
      0.0;  ///< probability of "yes", of the correct alternative, or of the second item, before it was drawn
};

/// Yes/no. Unbiased: P("yes") = guess + (1 - guess - lapse) F. An observer who lapses, in a share lapse / (1
/// - guess) of trials, says "yes" at the guess rate (so that the asymptote is 1 - lapse). A criterion shift c
/// changes the guess rate to Phi(Phi^-1(guess) - c) and, under signal detection, hits by the same shift.
/// Throws nothing; signal detection needs guess > 0.
double yesProbability(const DecisionSetting& setting);
Judgement decideYesNo(const DecisionSetting& setting, psychometrics::Random& random);

/// m alternatives, `target` of which has the change. Unbiased: P(right) = 1/m + (1 - 1/m - lapse) F. Under
/// signal detection the largest of m observations, after adding the bias to the first, is chosen; under high
/// threshold the bias affects only guesses, as if everything were noise.
double correctProbability(const DecisionSetting& setting, int alternatives, int target);
Judgement decideAlternative(const DecisionSetting& setting, int alternatives, int target,
                            psychometrics::Random& random);

/// Thurstone's case V between two items of these scale values, shown in the order first, second; the
/// judgement's probability is that of choosing the second.
double secondProbability(const DecisionSetting& setting, double first, double second);
Judgement decidePair(const DecisionSetting& setting, double first, double second,
                     psychometrics::Random& random);

/// Probability that the observation with mean `means[which]` and SD 1 is the largest: closed form for two,
/// Simpson's rule otherwise (absolute error below 1e-9).
double largestProbability(const std::vector<double>& means, size_t which);
/// d' at which an unbiased observer is right with probability p among m; 1/m <= p < 1.
double sensitivityOf(double p, int alternatives);

/// Step of a scale, from 1, for given evidence: one more for every bound it reaches.
int stepOf(double evidence, const std::vector<double>& bounds);

}  // namespace limen::study
