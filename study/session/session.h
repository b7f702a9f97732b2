// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "study/procedures/procedure.h"
#include "study/protocol/design.h"
#include "study/protocol/protocol.h"
#include "study/session/event.h"

namespace limen::study {

/// What is to be done now.
struct Screen {
  enum class Kind { Consent, Form, Instructions, PracticeStart, PracticeResult, BlockStart, Break, Debrief };
  Kind kind = Kind::Instructions;
  int part = 0, block = 0;
  bool passed = true;                   ///< PracticeResult only
  double atLeastS = 0.0;                ///< cannot be left earlier
  int trialsDone = 0, trialsInAll = 0;  ///< of the session, practice apart: progress, no hint of conditions
};
std::string toText(Screen::Kind kind);

/// A trial that is due, its stimuli decided.
struct Trial {
  int number = 0, attempt = 0;  ///< PlannedTrial::number; attempt counts from 0
  PlannedTrial plan;
  std::vector<double> procedureStimulus;  ///< empty unless adaptive
  std::vector<Stimulus> stimuli;          ///< as stimuliOf()
  /// Seed of all randomness within the trial (observers, noise), of session seed, number and attempt alone.
  uint64_t seed = 0;
};

struct Step {
  enum class Kind { Screen, Trial, Finished, Aborted } kind = Kind::Finished;
  std::optional<Screen> screen;
  std::optional<Trial> trial;
};

/// One participant's way through a protocol. Knows no clock, no file, no window: its state is decided by
/// protocol, seed, participant number and the events applied.
class Session {
 public:
  Session(const Protocol& protocol, uint64_t seed, int participantNumber);

  /// The same until an event moves it on.
  const Step& step() const { return step_; }
  /// Throws Error if the event cannot follow (a damaged log): says number, kind and what was due.
  void apply(const Event& event);

  const Protocol& protocol() const { return protocol_; }
  const Design& design() const { return design_; }
  /// Whether an answer is right: nullopt where there is no right one (Rating, Pairwise).
  static std::optional<bool> isCorrect(const Part& part, const PlannedTrial& trial,
                                       const std::string& answer);
  /// Index of an answer among the part's (0..), which procedures are fed with: for YesNo 1 for "yes", for
  /// Interval and Alternative 1 for a right answer, for Rating the step from 0.
  static int outcomeOf(const Part& part, const PlannedTrial& trial, const std::string& answer);
  const Procedure& procedure(int index) const { return *procedures_[static_cast<size_t>(index)]; }

  int trialsDone() const;   ///< answered, practice apart
  int trialsInAll() const;  ///< planned, practice apart; falls when a procedure ends early
  /// Everything that decides what comes: queue, procedures' states. Equal states have equal futures.
  nlohmann::json state() const;

 private:
  // (the state: position, the block's queue, attempts, practice counts, procedures)
  const Protocol& protocol_;
  Design design_;
  std::vector<std::unique_ptr<Procedure>> procedures_;
  Step step_;
};

}  // namespace limen::study
