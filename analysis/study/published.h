// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "analysis/observer_statistics/anova.h"

namespace limen::analysis {

// What Schwarz 2009 printed of its two experiments (sections 10.4.1 and 10.4.2), to be set beside the results
// of the protocols experiment_1 and experiment_2. All of it stands here and nowhere else.

/// How many were asked, and how much each.
struct PublishedDesign {
  std::string protocol;
  size_t observers = 0, trialsEach = 0;
  std::string source;
};

/// Mean over observers of their own rates of "yes", and its standard deviation (n - 1).
struct PublishedRate {
  double mean = 0.0, sd = 0.0;  ///< shares
  const char* source = "";
};
struct PublishedRateOf {
  std::string protocol, part;
  bool change = true;  ///< false: catch trials
  PublishedRate rate;
};

/// Over the scenarios of one kind of stimulus with a change: of each scenario's rate, and of its mean
/// severity.
struct PublishedScenarios {
  double meanRate = 0.0, sdRate = 0.0;          ///< shares
  double meanSeverity = 0.0, sdSeverity = 0.0;  ///< steps from 1
  std::string least;                            ///< what was said of the scores, in words
  int leastCoverageLevel = 0, leastRatingLevel = 0;
  std::string remark, source;
};
struct PublishedScenariosOf {
  std::string protocol, part, presentation;
  PublishedScenarios scenarios;
};

struct PublishedEffectOf {
  std::string protocol, part;
  std::vector<std::string> factors;
  PublishedEffect effect;
};

/// What was printed for a predictor and a set of scenarios.
struct PublishedAgreement {
  double tauC = 0.0, r = 0.0;
  bool clamped = false;  ///< r is that of clamped predictions
  const char* source = "";
};
struct PublishedAgreementOf {
  std::string protocol, part, set, predictor;
  bool severity = false;  ///< with mean severity, else with detection rates
  PublishedAgreement agreement;
};

const std::vector<PublishedDesign>& publishedDesigns();
const std::vector<PublishedRateOf>& publishedRates();
const std::vector<PublishedScenariosOf>& publishedScenarios();
const std::vector<PublishedEffectOf>& publishedEffects();
const std::vector<PublishedAgreementOf>& publishedAgreements();

// By the names of protocol and part; none if nothing was printed.
std::optional<PublishedRate> publishedRate(const std::string& protocol, const std::string& part, bool change);
std::optional<PublishedScenarios> publishedScenario(const std::string& protocol, const std::string& part,
                                                    const std::string& presentation);
/// `factors`: names of those that take part, in any order.
std::optional<PublishedEffect> publishedEffect(const std::string& protocol, const std::string& part,
                                               const std::vector<std::string>& factors);
std::optional<PublishedAgreement> publishedAgreement(const std::string& protocol, const std::string& part,
                                                     const std::string& set, const std::string& predictor,
                                                     bool severity);

}  // namespace limen::analysis
