// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "experiments/store/sessions.h"
#include "study/export/table.h"

namespace limen::study {

/// A byte that a recorder was sent while a trial ran.
struct ExportedMarker {
  int trial = 0, attempt = 0, code = 0;
  std::string marker;
  double dueS = 0.0, sentS = 0.0;  ///< from the beginning of the session
};

/// What is exported of a session: no participant code, nothing made of one, no time of day, no path.
struct ExportedSession {
  std::string subject;  ///< pseudonym, or the code if that was requested
  std::string name;     ///< of the sitting
  std::string protocolName, protocolTitle, protocolHash, displayName, displayHash, state, programVersion;
  bool simulated = false;        ///< no person answered
  std::optional<uint64_t> seed;  ///< only where participant codes are exported, which older ones are made of
  /// An older session, whose orders were drawn with a seed made of the participant's code: whoever guesses
  /// the code can check the guess against them.
  bool ordersTellCode = false;
  nlohmann::json form = nlohmann::json::object();
  /// Part -> its answers from left to right, as this participant saw them; {} in older stores.
  nlohmann::json answersFromTheLeft = nlohmann::json::object();
  std::vector<store::StudyTrial> trials;
  std::vector<ExportedMarker> markers;
  std::vector<double> startS;  ///< of each trial, from the beginning of its session
  std::vector<double> endS;    ///< of each trial: its answer or abandonment; below 0: never
};

/// Seconds of each event from the first one: by the steady clock, across a restart of program or machine by
/// the wall clock (never backwards).
std::vector<double> eventTimesS(const std::vector<store::StudyEvent>& events);

/// One row per trial shown, including practice and invalid attempts (see columns `practice`, `valid` and
/// `counts`), in presentation order: the long form that R and Python users expect.
Table trialTable(const std::vector<ExportedSession>& sessions);

/// One row per swap.
Table frameTable(const std::vector<ExportedSession>& sessions);

/// One row per marker.
Table markerTable(const std::vector<ExportedSession>& sessions);

/// One row per subject: form answers (age in bins), sessions.
Table participantTable(const std::vector<ExportedSession>& sessions);

/// Letters and digits of a name, as required for BIDS labels: "experiment_1" -> "experiment1"; "x" if none is
/// left.
std::string label(const std::string& name);

}  // namespace limen::study
