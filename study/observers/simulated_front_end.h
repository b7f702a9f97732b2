// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "study/observers/observer.h"
#include "study/observers/simulated_clock.h"
#include "study/session/front_end.h"

namespace limen::study {

struct SimulatedFrontEndSetting {
  nlohmann::json description;  ///< goes into environment()
  double refreshHz = 60.0;
  double invalidRate = 0.0;  ///< share of presentations that are invalid, as if frames had been late
  /// Called before everything else at each call of the session; returns true to end the session there, like a
  /// person who quits. For tests of resuming, and for Ctrl-C.
  std::function<bool()> quit;
  uint64_t seed = 0;  ///< of the form's answers
};

/// An observer in place of a person: no window, no waiting. Advances the clock by the trial's duration.
class SimulatedFrontEnd : public FrontEnd {
 public:
  SimulatedFrontEnd(SimulatedObserver& observer, SimulatedClock& clock, SimulatedFrontEndSetting setting);

  ScreenResult show(const Screen& screen, const Session& session) override;
  TrialResult present(const Trial& trial, const Session& session) override;
  void feedback(bool correct) override;
  nlohmann::json environment() const override;

 private:
  SimulatedObserver& observer_;
  SimulatedClock& clock_;
  SimulatedFrontEndSetting setting_;
  std::map<int, std::vector<std::string>> axisNames_;  // of the design's procedures
};

/// Values of a procedure's stimulus by the names of its dimensions.
Variables axesOf(const std::vector<std::string>& names, const std::vector<double>& stimulus);

/// Duration of a trial up to the question, in seconds, as stated by its protocol and stimuli.
double durationUpToQuestionS(const Timing& timing, const TaskSetting& task,
                             const std::vector<Stimulus>& stimuli);

}  // namespace limen::study
