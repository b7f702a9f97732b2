// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "study/session/front_end.h"

namespace limen::study {

/// Times between successive frames of the stimuli that were shown.
struct IntervalStatistics {
  int64_t count = 0;
  double meanMs = 0.0, sdMs = 0.0, longestMs = 0.0;
};

/// What an experimenter wants to know about a running session: its progress and how well the screen keeps
/// time. Does not see answers.
class SessionWatch {
 public:
  void progress(int trialsDone, int trialsInAll);
  void began(const Trial& trial, int64_t nowNs);
  void ended(const TrialResult& result, int64_t nowNs);
  /// Restarts the clock after time that is not part of a trial (a pause).
  void rested() { lastEndNs_ = 0; }
  void setScreen(const std::string& name) { screen_ = name; }

  const std::string& screen() const { return screen_; }
  int trialsDone() const { return done_; }
  int trialsInAll() const { return inAll_; }
  int trialsShown() const { return shown_; }  ///< in this sitting, practice and repeats included
  int trialsInvalid() const;
  const std::map<std::string, int>& invalidReasons() const { return invalid_; }
  int64_t missedBlanks() const { return missed_; }
  IntervalStatistics intervals() const;
  /// Of the remaining trials, without breaks, estimated from the trials so far; negative while unknown.
  double secondsLeft() const;
  /// All of it, one line each.
  std::vector<std::string> lines() const;

 private:
  std::string screen_;
  int done_ = 0, inAll_ = 0, shown_ = 0;
  std::map<std::string, int> invalid_;
  int64_t missed_ = 0, beganNs_ = 0, lastEndNs_ = 0;
  double trialSeconds_ = 0.0;
  int timedTrials_ = 0;
  // Welford 1962, Technometrics 4: mean and squared deviations without storing the values.
  int64_t count_ = 0;
  double mean_ = 0.0, squares_ = 0.0, longest_ = 0.0;
};

}  // namespace limen::study
