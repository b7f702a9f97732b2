// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "study/protocol/protocol.h"
#include "study/stimulus/stimulus.h"

namespace limen::study {

/// A trial as planned by the design; an adaptive one takes its stimulus from its procedure when it is due.
struct PlannedTrial {
  int number = 0;  ///< within the session's plan, from 0; practice rounds included
  int part = 0, block = 0;
  bool practice = false;
  std::map<std::string, std::string> condition;  ///< factor -> level's name; Pairwise: "item_a", "item_b"
  Variables variables;                           ///< all but those of the procedure's axes
  bool change = true;                            ///< false: catch trial (YesNo and Rating)
  int repetition = 0;
  int target = 0;  ///< Interval, Alternative: which one has the change; Pairwise: which one shows item_b
  /// Where `catch_shows` is balanced: whether what does not change shows the state after the change. Of
  /// several unchanged stimuli in a trial the first one does, the next one does not, and so on. Nothing:
  /// plans of version 1, which show the state before the change.
  std::optional<bool> unchangedShowsAfter;
  /// Index into Design::procedures, or -1. A catch trial of an adaptive part has one too: it is shown at the
  /// stimulus that the procedure requests next, and its answer is not fed back.
  int procedure = -1;
};

struct PlannedBlock {
  int part = 0;
  std::string name;  ///< "PART", "PART: LEVEL" or "PART: practice"
  bool practice = false;
  std::vector<PlannedTrial> trials;  ///< in presentation order
};

/// A procedure that runs in the session, one per condition of an adaptive part.
struct PlannedProcedure {
  int part = 0;
  std::map<std::string, std::string> condition;
  nlohmann::json settings;
  uint64_t seed = 0;
};

/// As many adaptive trials are planned as their procedure may request at most; if a procedure ends early, the
/// rest of its trials, including catch trials, are dropped.
struct Design {
  std::vector<PlannedBlock> blocks;
  std::vector<PlannedProcedure> procedures;
  /// Whether this participant sees counterbalanced answers from right to left.
  bool answersMirrored = false;
};

/// Version of plans, stored with each session. 2: catch trials and sides of answers are balanced.
inline constexpr int kPlanVersion = 2;
/// What an earlier version planned with the same arguments: sessions are resumed and checked as they began.
void asPlannedBefore(Design& design, int version);
void asPlannedBefore(PlannedBlock& block, int version);

/// Indices of a task's answers from left to right.
std::vector<size_t> answersShown(const TaskSetting& task, bool mirrored);

/// The plan of one session: a pure function of protocol, seed and the participant's number (from 0; picks
/// rows of Latin squares). Same arguments, same plan, on every machine.
Design makeDesign(const Protocol& protocol, uint64_t seed, int participantNumber);

/// Practice of a part; round 0 is the one in the design except for the trials' numbers and block. Trials of
/// further rounds continue the plan's numbering, separately for different parts. A pure function of its
/// arguments.
PlannedBlock makePracticeRound(const Protocol& protocol, int part, uint64_t seed, int round);

/// Stimuli of a trial in the order (Interval) or position (Alternative, Pairwise) in which they are shown:
/// one for YesNo and Rating. `axes` are the procedure's stimulus variables. Throws Error naming file and
/// line.
std::vector<Stimulus> stimuliOf(const Protocol& protocol, const PlannedTrial& trial,
                                const Variables& axes = {});

/// Balanced Latin square: row `row` of n treatments; for n even (Williams) every treatment follows every
/// other equally often over n rows, for n odd over 2 n rows. Source: Williams 1949; Bradley 1958.
std::vector<int> williamsRow(int treatments, int row);
/// Row of a cyclic Latin square, each treatment once in each position over n rows.
std::vector<int> latinRow(int treatments, int row);

}  // namespace limen::study
