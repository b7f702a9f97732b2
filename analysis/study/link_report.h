// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "analysis/statistics/interval.h"
#include "analysis/study/link.h"

namespace limen::analysis {

struct YesCount {
  int64_t yes = 0, trials = 0;
};
/// Of each observer, by StudyAnswer::observer.
using ObserverCounts = std::map<size_t, YesCount>;

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
