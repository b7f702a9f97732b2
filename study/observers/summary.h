// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "study/observers/observer.h"

namespace limen::study {

/// Mean and SD over participants of a rate; see PowerCell for what counts as positive.
struct RateSummary {
  int participants = 0, trials = 0;
  double mean = 0.0, sd = 0.0;
  double expected = 0.0;  ///< mean of the observers' own probabilities in the same trials
};

struct ConditionSummary {
  std::string part;
  std::map<std::string, std::string> condition;
  RateSummary change;
  std::optional<RateSummary> catches;
};

/// A parameter estimated by adaptive procedures, over participants, against the truth for each.
struct EstimateSummary {
  std::string part, procedure, unit, interval;
  std::map<std::string, std::string> condition;
  int participants = 0;
  int withoutInterval = 0;  ///< too few answers for an estimate or an interval; left out of the rest
  double meanTrue = 0.0, meanEstimate = 0.0;
  double bias = 0.0, rms = 0.0;  ///< estimate minus truth: mean, and root of the mean square
  double level = 0.95;           ///< of the intervals
  double coverage = 0.0;         ///< share of intervals that contain the truth
};

struct SimulationSummary {
  int sessions = 0, finished = 0, aborted = 0;
  int trials = 0, invalid = 0;  ///< answered, without practice; invalid presentations
  std::vector<ConditionSummary> parts, conditions;
  std::vector<EstimateSummary> estimates;
};

/// Summary of the simulated sessions of a protocol in a store; participants whose code starts with `prefix`.
/// Procedures are rerun on the stored answers. An estimate has a truth if the procedure has one stimulus
/// dimension and the observer's probability changes along it: the stimulus at which that equals the
/// probability that the procedure targets, or at which F equals F at its model's threshold. Drifting
/// observers count as they were at the beginning. Throws Error: a store that cannot be read.
SimulationSummary summarise(const Protocol& protocol, const std::string& store,
                            const ObserverBehaviour& behaviour, const std::string& prefix);

nlohmann::json toJson(const SimulationSummary& summary);
std::string toText(const SimulationSummary& summary);

/// "object, distance=4, presentation=static"
std::string conditionText(const std::string& part, const std::map<std::string, std::string>& condition);

}  // namespace limen::study
