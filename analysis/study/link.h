// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "analysis/statistics/interval.h"

namespace limen::analysis {

/// Answers to changes of one rating; minus infinity (kNoStimulus) for trials without a change.
struct LinkPoint {
  double rating = 0.0;
  int64_t yes = 0, trials = 0;
};

/// P(R) = g + (1 - g - l) / (1 + exp(-(R - m) / s)): how likely a rating is noticed. The form that
/// perception/popping/detection.h has.
struct Link {
  double guess = 0.0, lapse = 0.0;       ///< g, l
  double midpointR = 0.0, scaleR = 1.0;  ///< m, s
  double logLikelihood = 0.0;            ///< without binomial coefficients
  bool guessFitted = false, lapseFitted = false;
  std::string note;  ///< parameters that stand at the edge of what they may be; empty otherwise

  double probability(double rating) const;
};

/// What is fixed; the rest is fitted: a guess rate within 0 .. 0.5, a lapse rate within 0 .. 0.2.
struct LinkSetting {
  std::optional<double> guess, lapse;
};

/// Maximum of the likelihood: the logistic fit of analysis/psychometric, m its threshold, 2 ln 19 s its
/// width, within its bounds. None if fewer than two different ratings were shown, all answers to them are the
/// same, or rates that are held make the answers impossible.
std::optional<Link> fitLink(const std::vector<LinkPoint>& points, const LinkSetting& setting);

/// How well scenarios are told that a prediction has not seen.
struct LinkError {
  /// Mean over trials of -ln of the probability of what was answered; infinite if that was 0 once.
  double logLoss = 0.0;
  double brier = 0.0;    ///< mean over trials of the squared difference from the answer
  double rmsRate = 0.0;  ///< root of the mean square over scenarios of prediction minus rate
};
/// `probabilities`: one for each point.
LinkError linkError(const std::vector<LinkPoint>& points, const std::vector<double>& probabilities);

/// Each point's probability by the link that is fitted to all others; trials without a change stay in every
/// fit and are not predicted (entries are left out). None if one of the fits does not exist.
std::optional<std::vector<double>> leaveOneOut(const std::vector<LinkPoint>& points,
                                               const LinkSetting& setting);

struct YesCount {
  int64_t yes = 0, trials = 0;
};
/// Of each observer, by StudyAnswer::observer.
using ObserverCounts = std::map<size_t, YesCount>;
/// Mean over observers of their own rates.
double meanRate(const ObserverCounts& counts);

/// What is compared: one entry a scenario, and the catch trials of the part.
struct LinkData {
  std::vector<double> ratings, predicted;  ///< R, and the detection probability that was predicted
  std::vector<ObserverCounts> answers;
  ObserverCounts catches;
};

struct LinkReportSetting {
  LinkSetting link;       ///< guess rate none: that of catch trials
  bool fitGuess = false;  ///< guess rate fitted together with the catch trials
  size_t samples = 400;   ///< of the bootstrap; 0: none
  uint64_t seed = 1;
  unsigned threads = 2;  ///< change nothing but the time
};

/// 95 % percentile intervals; none where too few samples tell, or an end is infinite.
struct LinkErrorIntervals {
  std::optional<Interval> logLoss, brier, rmsRate;
};
struct LinkIntervals {
  size_t samples = 0, fitted = 0;  ///< drawn; of these with a fit, which the intervals are of
  uint64_t seed = 0;
  std::optional<Interval> guess, lapse, midpointR, scaleR;  ///< none of a rate that was held as given
  LinkErrorIntervals refitError, asPredicted, constant;
};

struct LinkReport {
  double guessFromCatch = 0.0;  ///< rate of reports in catch trials
  int64_t catchTrials = 0;
  std::optional<Link> refit;
  /// Of scenarios, each predicted without its own answers; none if there is no fit.
  std::optional<LinkError> refitError;
  std::optional<LinkError> asPredicted;  ///< of the probabilities that the prediction gave
  std::optional<LinkError> constant;     ///< of the mean rate of the other scenarios
  /// Over samples of as many observers drawn with replacement, all answers of each together, as those of one
  /// observer are not independent (Davison and Hinkley 1997, section 3.8). All is done anew with each sample:
  /// guess rate from catch trials, fit, leaving out. None without samples or with one observer.
  std::optional<LinkIntervals> intervals;
};

/// `observers`: how many there are, those without an answer included. Sample i takes its numbers from
/// childSeed(seed, "observers i").
LinkReport linkReport(const LinkData& data, const LinkReportSetting& setting, size_t observers);

}  // namespace limen::analysis
