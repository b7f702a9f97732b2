// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "study/observers/decision.h"
#include "study/observers/observer_kind.h"
#include "study/observers/simulation.h"
#include "study/session/session.h"

namespace limen::study {

/// A vision model's prediction for a stimulus.
struct StimulusPrediction {
  /// R of the region rated highest, at the cue if there is one; without a region, below the lowest possible.
  double rating = 0.0;
  bool popping = false;  ///< whether there is such a region
};
class StimulusModel {
 public:
  virtual ~StimulusModel() = default;
  /// Of the trial's stimulus `which`, shown at the procedure's variables `axes`. Throws Error if it cannot be
  /// rendered.
  virtual StimulusPrediction predict(const Trial& trial, const Variables& axes, size_t which) = 0;
};

struct ObserverResponse {
  std::string answer;  ///< one of TaskSetting::answers
  int outcome = 0;     ///< as in Session::outcomeOf()
  std::optional<int> severity, confidence;
  double reactionTimeS = 0.0;
  double detected = 0.0;     ///< F of this observer and trial; 0 without a change; Pairwise: not used
  double probability = 0.0;  ///< of "yes", of a correct answer, of item b, of more than the lowest rating
  bool lapsed = false;
};

/// One simulated observer. Its characteristics are drawn from its seed, its answers from each trial's seed:
/// the answer to a trial does not depend on earlier ones.
///
/// Rating gives the step that the evidence reaches; severity likewise, and confidence from the evidence's
/// distance from the criterion. If nothing was seen, or for a guess or a lapse, both are lowest.
class SimulatedObserver {
 public:
  /// `model` may be missing if no condition needs one.
  SimulatedObserver(const Simulation& simulation, const ObserverBehaviour& behaviour, uint64_t seed,
                    StimulusModel* model = nullptr);

  /// `axes`: the procedure's stimulus variables. Needs trial.stimuli only if the model does. Throws Error
  /// naming file and key if an expression cannot be evaluated or gives what is out of range.
  ObserverResponse respond(const Trial& trial, const Variables& axes = {}) {
    return respond(trial, axes, trial.seed);
  }
  ObserverResponse respond(const Trial& trial, const Variables& axes, uint64_t seed);

  /// Probability of outcome 1 (see Session::outcomeOf) at a stimulus; Rating: of more than the lowest.
  double probability(const Trial& trial, const Variables& axes = {});
  /// F at a stimulus.
  double detected(const Trial& trial, const Variables& axes = {});
  /// Whether a trial's condition needs the popping predictor.
  bool usesModel(const Trial& trial) const;

 private:
  struct Sight;  // how this observer perceives a trial
  Sight look(const Trial& trial, const Variables& axes);
  double detectedOf(const SimulationRules& rules, const Trial& trial, const Variables& axes);
  double shiftOf(const SimulationRules& rules, const PlannedTrial& trial);
  double valueOf(const SimulationRules& rules, const Trial& trial, const Variables& axes,
                 const std::string& item, size_t which);

  const Simulation& simulation_;
  ObserverBehaviour behaviour_;
  uint64_t seed_;
  StimulusModel* model_;
  double threshold_, width_, strength_, guess_, lapse_;  // standard normal each
};

}  // namespace limen::study
