// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "analysis/study/plan.h"

namespace limen::analysis {

/// An answer that counts: of a valid trial, no practice, its block not begun anew.
struct StudyAnswer {
  size_t observer = 0;  ///< index of StudyAnswers::observers
  size_t part = 0;      ///< index of StudyPlan::parts
  int64_t session = 0;  ///< row of the store
  int trial = 0;        ///< number in the session's plan
  std::map<std::string, std::string> condition;
  std::vector<double> axes;  ///< what a procedure asked for, in the order of StudyPart::axes
  std::string presentation;  ///< "dynamic", "static"; "" if stimuli say nothing
  bool change = true;        ///< false: catch trial
  /// Of a catch trial: the state that it showed throughout, "before" or "after" the change; "" if not
  /// recorded.
  std::string catchShows;
  /// Of what was shown; with several the one in the interval or at the position of the change.
  std::string stimulusHash;
  std::string displayHash;
  int outcome = 0;  ///< 1: "yes", or right; Rating: step from 0; Pairwise: position that was chosen
  int target = 0;   ///< Pairwise: position of the condition's "item_b"
  int repetition = 0;
  std::optional<int> severity;
  double reactionTimeS = 0.0;
};

/// What a rule takes away, or took away: whole observers, or single answers of one.
struct LeftOut {
  std::string rule, observer;
  size_t answers = 0;
  std::string detail;
};
/// What became of a declared rule.
struct AppliedRule {
  std::string name;
  double limit = 0.0;
  bool applied = false;
  std::string note;  ///< why not, or to whom not
};

/// The answers to one protocol in one store.
struct StudyAnswers {
  StudyPlan plan;
  std::vector<std::string> observers;  ///< as ObserverNames calls them, in order of their first session
  std::vector<StudyAnswer> answers;
  size_t sessions = 0;
  size_t simulated = 0;               ///< sessions of simulated observers: all of them or none
  size_t notLabReady = 0;             ///< sessions that began although timing was not ready for a laboratory
  std::vector<std::string> displays;  ///< names of the displays that were used
  std::vector<AppliedRule> rules;     ///< as declared
  std::vector<LeftOut> leftOut;       ///< sessions that were not finished among them
};

/// What the program that showed a session's stimuli said of itself; {} if it said nothing.
nlohmann::json frontEndOf(const store::Environment& environment);
bool isSimulated(const store::Environment& environment);

enum class Observers { Either, People, Simulated };

struct StudyChoice {
  std::string store;
  std::string protocol;                     ///< name or SHA-256; "" if the store has answers to one only
  bool exclusions = true;                   ///< apply the rules that the protocol declares
  bool unfinished = false;                  ///< take sessions that were broken off too
  Observers observers = Observers::Either;  ///< Either: whichever the store has, but not both
  bool codes = false;                       ///< name people by their codes
};

/// Reads, then applies the protocol's rules in the order in which it declares them, those on single answers
/// first: a rule on an observer looks at the answers that are left.
///
/// reaction_time_below_s, reaction_time_above_s: answers given before, after that time. catch_rate_above:
/// observers who said yes to a larger share of their catch trials, of all parts together. lapse_above:
/// observers whose fitted lapse rate is larger, where their answers tell it (lapseRates()).
///
/// Throws Error: no store, no session, several protocols and none named, no such protocol, sessions of
/// people and of simulated observers, no answer left.
StudyAnswers readStudyAnswers(const StudyChoice& choice);

/// Whether a session of such a kind of observer is left out.
inline bool isOther(Observers wanted, bool simulated) {
  return wanted == (simulated ? Observers::People : Observers::Simulated);
}

/// The second half of readStudyAnswers(), without the check that anything is left.
void applyExclusions(StudyAnswers& study);

/// Levels of an answer's condition as indices into the part's factors, for sorting and grouping; levels that
/// the protocol does not list come last.
std::vector<size_t> levelsOf(const StudyPart& part, const std::map<std::string, std::string>& condition);
/// "lod_change=2_to_3, presentation=static", in the order of the part's factors.
std::string conditionText(const StudyPart& part, const std::map<std::string, std::string>& condition);

}  // namespace limen::analysis
