// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "study/session/run.h"

namespace limen::study {

/// A clock that moves a millisecond each time that it is read, both sides alike.
class TestClock : public Clock {
 public:
  explicit TestClock(double startS = 1.8e9) : wallMs_(static_cast<int64_t>(startS * 1e3)) {}
  std::string utc() override;
  int64_t monotonicNs() override { return monotonicMs_ * 1000000; }
  std::string boot() override { return boot_; }
  void pass(double seconds) { move(seconds), monotonicMs_ += static_cast<int64_t>(seconds * 1e3); }
  void move(double seconds) { wallMs_ += static_cast<int64_t>(seconds * 1e3); }  ///< the wall clock alone
  std::string boot_ = "boot";

 private:
  int64_t wallMs_, monotonicMs_ = 5000;
};

/// Answers as it is told: by default each answer hangs on the trial's number alone.
class ScriptedFrontEnd : public FrontEnd {
 public:
  explicit ScriptedFrontEnd(const Protocol& protocol) : protocol_(protocol) {}
  ScreenResult show(const Screen& screen, const Session& session) override;
  TrialResult present(const Trial& trial, const Session& session) override;
  void feedback(bool correct) override { log.push_back(correct ? "right" : "wrong"); }
  nlohmann::json environment() const override { return {{"gpu", "none"}, {"simulated", true}}; }

  /// Index of the answer to a trial.
  std::function<int(const Trial&)> answer;
  /// Called first; what it returns other than Done is what happens.
  std::function<Outcome(const Trial&, const Session&)> trialOutcome;
  std::function<ScreenResult(const Screen&)> screenResult;
  std::vector<std::string> log;  ///< screens by name, trials as "NUMBER.ATTEMPT", feedback
  std::vector<Trial> trials;
  std::vector<Screen> screens;
  int frames = 3;  ///< in each frame log

 private:
  const Protocol& protocol_;
};

/// Index of the answer that makes a trial right or wrong.
int answerIndex(const Part& part, const PlannedTrial& trial, bool right);

/// One part without factors: yes or no, a change `changes` times and a catch trial `catches` times.
Protocol smallProtocol(int changes = 6, int catches = 2);
/// Three parts: yes/no in two blocks with severity, practice and breaks; a staircase in two intervals for two
/// conditions; a rating.
Protocol largeProtocol();

/// What kill_victim runs: the large protocol, with trials that are invalid the first times.
Protocol killedProtocol();
Outcome killedOutcome(const Trial& trial, const Session& session);

}  // namespace limen::study
