// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "study/session/run.h"

namespace limen::study {

/// An event to be logged, with the frames of the trial that it ends; `before` is the session just before it.
using Observe = std::function<void(const Session& before, const Event&, const std::vector<ShownFrame>&)>;

/// Destination of events. `prepare` sees each event before the session takes it; `commit` makes all events
/// prepared since the last one durable, or throws.
struct Sink {
  Observe prepare;
  std::function<void()> commit;
};

/// The last event of a log, to tell a wall clock that was set.
struct LastInstant {
  std::string utc;
  int64_t monotonicNs = 0;
};

/// Runs a session on a front end: one round calls the front end once and commits the result.
class Loop {
 public:
  Loop(Session& session, FrontEnd& frontEnd, Clock& clock, Sink sink,
       std::function<void(const std::string&)> warn, std::optional<LastInstant> last = std::nullopt);

  /// Appends one event (and a clock jump before it, if the wall clock was set) with everything that follows
  /// from it.
  void record(EventKind kind, nlohmann::json data, const std::vector<ShownFrame>& frames = {});
  /// Until the session has ended (true) or paused (false).
  bool run();
  int trialsInvalid() const { return invalid_; }
  /// Invalid trials of an earlier sitting of the session.
  void startFrom(int trialsInvalid) { invalid_ = trialsInvalid; }

 private:
  void add(EventKind kind, nlohmann::json data, const std::vector<ShownFrame>& frames);
  void addClockJump();
  void addWhatFollows(EventKind kind, const Step& before);
  bool showScreen();
  bool presentTrial();
  void recordNotes();

  Session& session_;
  FrontEnd& frontEnd_;
  Clock& clock_;
  Sink sink_;
  std::function<void(const std::string&)> warn_;
  std::optional<LastInstant> last_;
  LastInstant now_;
  int invalid_ = 0;
};

}  // namespace limen::study
