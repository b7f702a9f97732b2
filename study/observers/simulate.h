// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "perception/vision/display.h"
#include "study/observers/observer.h"
#include "study/session/run.h"

namespace limen::study {

struct SimulationRequest {
  std::string store;  ///< SQLite file
  int observers = 200;
  uint64_t seed = 1;
  ObserverChoice observer;
  std::string prefix = "S";  ///< participants are PREFIX001, PREFIX002, ...
  int jobs = 1;              ///< threads
  double invalidRate = 0.0;  ///< see SimulatedFrontEndSetting
  Durability durability = Durability::ProcessKill;
  perception::DisplayProfile display;
  /// Called from any thread, one call at a time, before each screen and trial: trials answered so far in this
  /// call and observers done; true ends all sessions as a pause that can be resumed.
  std::function<bool(int64_t, int)> progress;
};

struct SimulationEnd {
  int newSessions = 0, resumed = 0, skipped = 0;  ///< skipped: finished or aborted before
  bool stopped = false;                           ///< by `progress`
};

/// Runs a session of every observer that has none yet and resumes those that were killed. Participant i
/// has number i of the counterbalancing in a fresh store, whatever `jobs` is, session seed childSeed(seed,
/// code) and observer seed childSeed(session seed, "observer"). Answers are those of an uninterrupted run.
/// Throws Error: a store whose sessions are not those of this protocol, seed and observer, and whatever
/// runSession() refuses. `model`: needed if a condition is predicted; only with one job.
SimulationEnd simulateSessions(const Protocol& protocol, const SimulationRequest& request,
                               StimulusModel* model = nullptr);

std::string participantCode(const std::string& prefix, int index);  ///< index from 0: "S001"
uint64_t sessionSeed(uint64_t seed, const std::string& participant);
uint64_t observerSeed(uint64_t sessionSeed);

}  // namespace limen::study
