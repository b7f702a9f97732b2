// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "perception/psychometrics/sigmoid.h"
#include "study/protocol/design.h"
#include "study/protocol/protocol.h"

namespace limen::study {

/// How a detection strength becomes an answer (Macmillan and Creelman 2005, chapters 1, 4 and 7):
///   - high threshold: the change is detected with probability F(x); an observer who detects nothing guesses,
///   "yes"
///     with the guess rate, or one of m alternatives;
///   - signal detection: equal-variance normal noise and a criterion, whose place is given by the guess rate
///   (the rate
///     of false alarms), or the largest of m observations. d' is such that the unbiased observer answers with
///     the same probability as under high threshold, so that the theory only determines the effect of bias
///     and confidence.
enum class DetectionTheory { HighThreshold, SignalDetection };

/// Standard deviations over observers, all normal.
struct ObserverSpread {
  double thresholdSd = 0.0;     ///< of the threshold, in its own unit
  double thresholdSdLog = 0.0;  ///< of ln(threshold)
  double widthSdLog = 0.0;      ///< of ln(width)
  double strengthSd = 0.0;      ///< of the sigmoid's argument, in its standard form: all conditions alike
  double conditionSd = 0.0;     ///< the same, drawn anew for each condition
  double guessSdLogit = 0.0, lapseSdLogit = 0.0;
  double itemsSd = 0.0;  ///< of each item's scale value
};

/// What a simulated observer sees in a condition, and how that becomes an answer.
struct SimulationRules {
  enum class Source {
    Model,    ///< the popping predictor on the trial's stimuli
    Sigmoid,  ///< a psychometric function of a variable
    Detected  ///< F itself
  } source = Source::Model;
  DetectionTheory theory = DetectionTheory::HighThreshold;
  Expression variable, threshold, width, detected, guess, lapse;
  psychometrics::SigmoidFamily family = psychometrics::SigmoidFamily::Logistic;
  psychometrics::StimulusAxis axis = psychometrics::StimulusAxis::Linear;
  bool falling = false, widthIsSlope = false;
  double level = 0.5;  ///< F at the threshold
  /// Lower bounds of the evidence (see Judgement) for steps 2, 3, ... of the scales; the first of `rating` is
  /// 0, so that "more than the lowest" is as frequent as "yes".
  std::vector<double> severity, confidence, rating;
  std::map<std::string, double> items;  ///< Pairwise: scale value of each level of Part::items
  ObserverSpread spread;
  double reactionMedianS = 0.7, reactionSdLog = 0.35;
  std::string where;  ///< file and line, for messages
};

/// A protocol's `simulation:` block, checked. Keys, at the top for all parts, or below `parts: {NAME: {...}}`
/// for one, or in an entry of `conditions: [{where: {FACTOR: LEVEL}, ...}]` of either for some conditions;
/// the more specific one wins; of conditions, the last that matches:
///
///     theory              high_threshold (default) or signal_detection (needs a guess rate above 0)
///     variable            stimulus variable x: a name, or "= expression" over the trial's variables
///     sigmoid             family of F (perception/psychometrics/standard_sigmoid.h); logistic
///     axis                linear (default) or log: F is a function of ln x
///     direction           rising (default) or falling with x
///     threshold           x at which F is `level` (0.5); a number or "= expression"
///     width | slope       from F = 0.05 to 0.95 (of ln x on a log axis) | dF/dx at the threshold
///     detected            instead of all these: F itself
///     guess, lapse        P(yes) = guess + (1 - guess - lapse) F; 0 and 0. With m alternatives the guess
///     rate is 1/m severity, confidence, rating   lower bounds of the evidence for the steps 2, 3, ... of the
///     scale;
///                         1, 2, ... (rating 0, 1, 2, ...)
///     items               {LEVEL: scale value} of pairwise comparisons: Thurstone's case V, P(b over a) =
///                         Phi((b - a) / sqrt 2); the larger wins (Thurstone 1927, Psychological Review 34)
///     between_observers   {threshold_sd, threshold_sd_log, width_sd_log, strength_sd, condition_sd,
///     guess_sd_logit,
///                         lapse_sd_logit, items_sd}
///     reaction_time       {median_s, sd_log} of a log-normal distribution
///
/// Conditions without `variable`, `detected` or `items` use the popping predictor.
class Simulation {
 public:
  /// Throws Error that names file, line (where the protocol has a text) and key: unknown keys, parts,
  /// factors, levels, values out of range, conditions that do not resolve.
  explicit Simulation(const Protocol& protocol);
  ~Simulation();

  const Protocol& protocol() const { return protocol_; }
  /// The rules of a part's condition. Safe to call from several threads; the reference stays valid.
  const SimulationRules& rules(int part, const std::map<std::string, std::string>& condition) const;
  /// Whether the answers of any condition need the predictor.
  bool needsModel() const { return needsModel_; }

 private:
  struct Cache;
  SimulationRules read(int part, const std::map<std::string, std::string>& condition) const;

  const Protocol& protocol_;
  bool needsModel_ = false;
  std::unique_ptr<Cache> cache_;
};

/// Value of an expression as a finite number. Throws Error.
double numberOf(const Expression& expression, const Variables& variables, const std::string& where,
                const std::string& file);

}  // namespace limen::study
