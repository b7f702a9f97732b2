// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "perception/vision/display.h"
#include "study/protocol/protocol.h"
#include "study/session/front_end.h"
#include "study/session/session.h"

namespace limen::study {

/// Time as a session sees it; a simulated one is exact and instant.
class Clock {
 public:
  virtual ~Clock() = default;
  virtual std::string utc() = 0;
  virtual int64_t monotonicNs() = 0;
  /// Identifies the machine's current boot, within which monotonicNs() is continuous; "": unknown.
  virtual std::string boot() { return {}; }
};
Clock& systemClock();

/// What a committed event survives: a power cut, or (for simulations, which can be repeated) only the end of
/// the process, by any signal.
enum class Durability { PowerLoss, ProcessKill };

struct SessionRequest {
  std::string store;          ///< SQLite file
  std::string participant;    ///< code: letters, digits, - and _
  std::string session = "1";  ///< number or name of the sitting
  uint64_t seed = 0;          ///< of a new session; a resumed one keeps its own
  bool resume = false;
  Durability durability = Durability::PowerLoss;
  perception::DisplayProfile display;
  nlohmann::json calibration = nlohmann::json::object();  ///< how the display profile was measured
  /// Receives non-fatal messages for the experimenter (such as a wall clock that was set). Standard error if
  /// empty.
  std::function<void(const std::string&)> warn;
};

struct SessionEnd {
  Step::Kind kind = Step::Kind::Finished;  ///< Screen or Trial: paused before it, or in the middle of it
  int64_t session = 0;                     ///< row id; 0: not stored
  int trialsAnswered = 0, trialsInvalid = 0;
};

/// Runs or resumes a session until its end, a pause that quits, or an abort. Every event is committed to the
/// store before the front end is called again. Throws Error: participant and session already known (without
/// `resume`), another protocol or display than the session began with, too old, held by a living process, a
/// store that cannot be written. What was committed stays.
SessionEnd runSession(const Protocol& protocol, const SessionRequest& request, FrontEnd& frontEnd,
                      Clock& clock = systemClock());

/// The same without a store, for simulations by the thousand: from the start to the end, `events` the log.
SessionEnd runInMemory(const Protocol& protocol, uint64_t seed, int participantNumber, FrontEnd& frontEnd,
                       Clock& clock, std::vector<Event>& events);

}  // namespace limen::study
