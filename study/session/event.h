// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

namespace limen::study {

/// What happened in a session, in order. A session's state is a replay of its events; nothing else affects
/// it.
enum class EventKind {
  Started,       ///< {protocol_hash, seed, participant_number, plan_version, answers_from_the_left ...}
  Continued,     ///< after a kill or a quit: {policy, gap_s, environment}
  ScreenDone,    ///< {screen, answers}: consent, form, instructions, break ... left
  TrialStarted,  ///< {trial, attempt, procedure_stimulus, stimulus_hashes}
  Answered,  ///< {trial, attempt, answer, correct, severity, confidence, reaction_time_s, device, markers}
  TrialInvalid,  ///< {trial, attempt, reason, markers}: frames late, window lost, paused in the middle
  Paused,        ///< {}
  Note,          ///< {by, text}
  ClockJump,     ///< {wall_s, monotonic_s}: the wall clock was set
  Aborted,       ///< {by, reason}
  Finished       ///< {}
};
std::string toText(EventKind kind);
EventKind eventKind(const std::string& text);

struct Event {
  int number = 0;  ///< within its session, from 0 without gaps
  EventKind kind = EventKind::Started;
  std::string utc;          ///< wall clock, ISO 8601 with milliseconds
  int64_t monotonicNs = 0;  ///< steady clock of the machine; restarts at boot
  nlohmann::json data = nlohmann::json::object();
};

}  // namespace limen::study
