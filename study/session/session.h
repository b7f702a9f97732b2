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

/// What to do now.
struct Screen {
  enum class Kind { Consent, Form, Instructions, PracticeStart, PracticeResult, BlockStart, Break, Debrief };
  Kind kind = Kind::Instructions;
  int part = 0, block = 0;
  bool passed = true;                   ///< PracticeResult only
  double atLeastS = 0.0;                ///< cannot be left earlier
  int trialsDone = 0, trialsInAll = 0;  ///< of the session, without practice: progress, no hint of conditions
};
std::string toText(Screen::Kind kind);

/// A trial that is due, with its stimuli.
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

/// One participant's course through a protocol. Independent of clock, files and windows: its state is
/// determined by protocol, seed, participant number and the events applied.
class Session {
 public:
  /// `planVersion`: that with which a stored session began (planVersionOf()).
  Session(const Protocol& protocol, uint64_t seed, int participantNumber, int planVersion = kPlanVersion);

  /// Unchanged until an event advances it.
  const Step& step() const { return step_; }
  /// Throws Error if the event cannot follow (a damaged log): says number, kind and what was due.
  void apply(const Event& event);

  const Protocol& protocol() const { return protocol_; }
  const Design& design() const { return design_; }
  int planVersion() const { return planVersion_; }
  /// Part -> its answers from left to right, as they are on screen for this participant.
  nlohmann::json answersFromTheLeft() const;
  /// Whether an answer is correct: nullopt if there is no correct one (Rating, Pairwise).
  static std::optional<bool> isCorrect(const Part& part, const PlannedTrial& trial,
                                       const std::string& answer);
  /// Index of an answer among the part's (0..), which procedures are fed with: for YesNo 1 for "yes", for
  /// Interval and Alternative 1 for a correct answer, for Rating the step from 0.
  static int outcomeOf(const Part& part, const PlannedTrial& trial, const std::string& answer);
  const Procedure& procedure(int index) const { return *procedures_[static_cast<size_t>(index)]; }

  int trialsDone() const { return done_; }  ///< answered, without practice
  int trialsInAll() const;  ///< planned, without practice; decreases when a procedure ends early
  /// Everything that determines what comes next: queue, procedures' states. Equal states have equal futures.
  nlohmann::json state() const;

  uint64_t seed() const { return seed_; }
  int participantNumber() const { return participantNumber_; }
  int nextEvent() const { return nextEvent_; }  ///< number that the next event must have
  /// Whether the trial that is due is on screen: begun, and neither answered nor invalid.
  bool trialInProgress() const { return inProgress_; }
  /// Block of the trial that is due, as index of Design::blocks. There is one.
  int blockOfDue() const { return queue_.front().slot.block; }
  /// How often a trial was invalid (late frames and the like; interruptions do not count).
  int timesInvalid(int trial) const;
  /// First event of the block (or round of practice) that would start over if the session were interrupted
  /// now under ResumePolicy::RestartBlock; nothing between blocks.
  std::optional<int> brokenBlockEvent() const;

 private:
  enum class Stage {
    Consent,
    Form,
    Instructions,
    PracticeStart,
    PracticeResult,
    BlockStart,
    Break,
    Trials,
    Debrief,
    Finished,
    Aborted
  };
  /// A trial of the plan and its block; all rounds of practice belong to the first one's.
  struct Slot {
    const PlannedTrial* trial = nullptr;
    int block = 0;
  };
  /// A block, or one round of practice.
  struct Stretch {
    int part = 0;
    bool practice = false;
    std::vector<Slot> slots;
  };
  struct Queued {
    Slot slot;
    std::optional<std::vector<double>> stimulus;  ///< of an adaptive trial begun earlier
  };

  void makeStretches();
  bool isOver(const Slot& slot) const;
  void enter(size_t stretch, bool pause);
  void begin(size_t stretch);
  void endStretch();
  void restartStretch();
  void dropFinished();
  void settle();
  void settleTrial();
  void leaveScreen(const Event& event);
  void startTrial(const Event& event);
  void endTrial(const Event& event);
  void requeue(Queued trial);
  void feed(int procedure, const std::vector<double>& stimulus, int outcome);
  void rebuildProcedures();
  [[noreturn]] void refuse(const Event& event, const std::string& why) const;

  const Protocol& protocol_;
  uint64_t seed_;
  int participantNumber_, planVersion_;
  Design design_;
  std::vector<PlannedBlock> rounds_;  ///< of practice after the first
  std::vector<Stretch> stretches_;
  std::vector<ProcedureSettings> settings_;
  std::vector<std::unique_ptr<Procedure>> procedures_;
  std::vector<std::optional<std::vector<double>>> nexts_;  ///< of the procedures, requested once per answer
  std::vector<std::vector<ProcedureTrial>> fed_;           ///< what the procedures were fed

  int nextEvent_ = 0;
  Stage stage_ = Stage::Consent;
  size_t stretch_ = 0;
  std::vector<Queued> queue_;  ///< of the stretch, the due one first
  std::map<int, int> attempts_, invalid_;
  bool inProgress_ = false, paused_ = false;
  int done_ = 0, sinceBreak_ = 0, right_ = 0;
  bool passed_ = true;
  std::optional<int> begunAt_;  ///< first event of a trial of the stretch
  int doneBefore_ = 0;          ///< done_ when the stretch began
  std::vector<size_t> fedBefore_;
  Step step_;
};

/// Version of the plan of a stored session, whose first event has these data.
int planVersionOf(const nlohmann::json& started);

}  // namespace limen::study
