// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

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

}  // namespace limen::analysis
