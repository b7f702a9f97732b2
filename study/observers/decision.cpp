// SPDX-License-Identifier: BSD-3-Clause
#include "study/observers/decision.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

namespace limen::study {
namespace {

using psychometrics::Random;
using psychometrics::SigmoidFamily;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Probabilities are clamped to this distance from 0 and 1, so that d' stays finite: less than any study could
// detect.
constexpr double kNearest = 1e-12;

double phi(double z) { return psychometrics::standardValue(SigmoidFamily::Normal, z); }
double phiInverse(double p) {
  return psychometrics::standardInverse(SigmoidFamily::Normal, std::clamp(p, kNearest, 1.0 - kNearest));
}

bool isSignalDetection(const DecisionSetting& setting) {
  return setting.theory == DetectionTheory::SignalDetection;
}

double yesLapse(const DecisionSetting& setting) { return setting.lapse / (1.0 - setting.guess); }
double choiceLapse(const DecisionSetting& setting, int m) { return setting.lapse / (1.0 - 1.0 / m); }

// Rate of "yes" of an observer who saw nothing. A guess rate of 0 has no criterion that could move.
double shiftedGuess(const DecisionSetting& setting) {
  if (setting.criterionShift == 0.0 || setting.guess <= 0.0) return setting.guess;
  return phi(phiInverse(setting.guess) - setting.criterionShift);
}

struct YesNoMeans {
  double sensitivity, criterion;
};

YesNoMeans yesNoMeans(const DecisionSetting& setting) {
  assert(setting.guess > 0.0);
  const double unbiased = -phiInverse(setting.guess);
  const double hits = setting.guess + (1.0 - setting.guess) * setting.detected;
  return {setting.detected > 0.0 ? phiInverse(hits) + unbiased : 0.0, unbiased + setting.criterionShift};
}

// Evidence of a detected change under high threshold: as strong as F is high, with noise, but above the
// criterion.
double detectedEvidence(double detected, Random& random) {
  return std::max(0.0, phiInverse(detected) + random.normal());
}

std::vector<double> biasedMeans(const DecisionSetting& setting, int m, int target, double sensitivity) {
  std::vector<double> means(static_cast<size_t>(m), 0.0);
  means[static_cast<size_t>(target)] = sensitivity;
  means[0] += setting.firstBias;
  return means;
}

double alternativeSensitivity(const DecisionSetting& setting, int m) {
  return setting.detected > 0.0 ? sensitivityOf(1.0 / m + (1.0 - 1.0 / m) * setting.detected, m) : 0.0;
}

// The largest of observations around the means: which, and by how much.
Judgement chooseLargest(const std::vector<double>& means, Random& random) {
  double best = -kInfinity, second = -kInfinity;
  Judgement out;
  for (size_t i = 0; i < means.size(); ++i) {
    const double observation = means[i] + random.normal();
    if (observation > best) {
      second = best;
      best = observation;
      out.choice = static_cast<int>(i);
    } else {
      second = std::max(second, observation);
    }
  }
  out.evidence = best - second;
  return out;
}

}  // namespace

double yesProbability(const DecisionSetting& setting) {
  const double lapsing = yesLapse(setting);
  double attending;
  if (isSignalDetection(setting)) {
    const YesNoMeans means = yesNoMeans(setting);
    attending = phi(means.sensitivity - means.criterion);
  } else {
    attending = setting.detected + (1.0 - setting.detected) * shiftedGuess(setting);
  }
  return lapsing * setting.guess + (1.0 - lapsing) * attending;
}

Judgement decideYesNo(const DecisionSetting& setting, Random& random) {
  Judgement out;
  out.probability = yesProbability(setting);
  if (random.chance(yesLapse(setting))) {
    out.lapsed = true;
    out.choice = random.chance(setting.guess) ? 1 : 0;
    out.evidence = out.choice ? 0.0 : -kInfinity;
    return out;
  }
  if (isSignalDetection(setting)) {
    const YesNoMeans means = yesNoMeans(setting);
    out.evidence = means.sensitivity + random.normal() - means.criterion;
    out.choice = out.evidence >= 0.0 ? 1 : 0;
    return out;
  }
  if (random.chance(setting.detected)) {
    out.choice = 1;
    out.evidence = detectedEvidence(setting.detected, random);
  } else {
    out.choice = random.chance(shiftedGuess(setting)) ? 1 : 0;
    out.evidence = out.choice ? 0.0 : -kInfinity;
  }
  return out;
}

double correctProbability(const DecisionSetting& setting, int m, int target) {
  const double lapsing = choiceLapse(setting, m);
  const size_t which = static_cast<size_t>(target);
  double attending;
  if (isSignalDetection(setting)) {
    attending =
        largestProbability(biasedMeans(setting, m, target, alternativeSensitivity(setting, m)), which);
  } else {
    const double guessed = largestProbability(biasedMeans(setting, m, target, 0.0), which);
    attending = setting.detected + (1.0 - setting.detected) * guessed;
  }
  return lapsing / m + (1.0 - lapsing) * attending;
}

Judgement decideAlternative(const DecisionSetting& setting, int m, int target, Random& random) {
  Judgement out;
  if (random.chance(choiceLapse(setting, m))) {
    out.lapsed = true;
    out.choice = static_cast<int>(random.below(static_cast<uint64_t>(m)));
    out.evidence = -kInfinity;
  } else if (isSignalDetection(setting)) {
    out = chooseLargest(biasedMeans(setting, m, target, alternativeSensitivity(setting, m)), random);
  } else if (random.chance(setting.detected)) {
    out.choice = target;
    out.evidence = detectedEvidence(setting.detected, random);
  } else {
    out = chooseLargest(biasedMeans(setting, m, target, 0.0), random);
    out.evidence = -kInfinity;
  }
  out.probability = correctProbability(setting, m, target);
  return out;
}

double secondProbability(const DecisionSetting& setting, double first, double second) {
  const double lapsing = choiceLapse(setting, 2);
  return lapsing / 2.0 + (1.0 - lapsing) * largestProbability({first + setting.firstBias, second}, 1);
}

Judgement decidePair(const DecisionSetting& setting, double first, double second, Random& random) {
  Judgement out;
  if (random.chance(choiceLapse(setting, 2))) {
    out.lapsed = true;
    out.choice = static_cast<int>(random.below(2));
    out.evidence = -kInfinity;
  } else {
    out = chooseLargest({first + setting.firstBias, second}, random);
  }
  out.probability = secondProbability(setting, first, second);
  return out;
}

double largestProbability(const std::vector<double>& means, size_t which) {
  assert(means.size() >= 2 && which < means.size());
  const double own = means[which];
  if (means.size() == 2) return phi((own - means[1 - which]) / std::numbers::sqrt2);
  constexpr int kIntervals = 160;  // even
  constexpr double kReach = 8.0, kStep = 2.0 * kReach / kIntervals;
  double sum = 0.0;
  for (int i = 0; i <= kIntervals; ++i) {
    const double z = -kReach + i * kStep;
    double density = std::exp(-0.5 * z * z);
    for (size_t j = 0; j < means.size(); ++j)
      if (j != which) density *= phi(own + z - means[j]);
    sum += density * (i == 0 || i == kIntervals ? 1.0 : i % 2 ? 4.0 : 2.0);
  }
  return sum * kStep / 3.0 / std::sqrt(2.0 * std::numbers::pi);
}

double sensitivityOf(double p, int m) {
  assert(m >= 2);
  p = std::min(p, 1.0 - kNearest);
  if (m == 2) return std::numbers::sqrt2 * phiInverse(p);
  if (p <= 1.0 / m) return 0.0;
  const auto rate = [m](double sensitivity) {
    std::vector<double> means(static_cast<size_t>(m), 0.0);
    means[0] = sensitivity;
    return largestProbability(means, 0);
  };
  // Bracketed, and by the secant in terms of Phi^-1, in which the curve is nearly straight.
  double low = 0.0, high = 14.0, zLow = phiInverse(1.0 / m), zHigh = phiInverse(rate(high));
  const double z = phiInverse(p);
  if (z >= zHigh) return high;
  for (int i = 0; i < 60 && high - low > 1e-10; ++i) {
    // Every third step bisects, so that both ends close in.
    const double share = i % 3 == 2 ? 0.5 : std::clamp((z - zLow) / (zHigh - zLow), 1e-3, 1.0 - 1e-3);
    const double middle = low + share * (high - low);
    const double zMiddle = phiInverse(rate(middle));
    if (std::abs(zMiddle - z) < 1e-11) return middle;
    (zMiddle < z ? low : high) = middle;
    (zMiddle < z ? zLow : zHigh) = zMiddle;
  }
  return 0.5 * (low + high);
}

int stepOf(double evidence, const std::vector<double>& bounds) {
  return 1 + static_cast<int>(std::count_if(bounds.begin(), bounds.end(),
                                            [evidence](double bound) { return evidence >= bound; }));
}

}  // namespace limen::study
