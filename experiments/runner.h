// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <unordered_set>
#include <vector>

#include "experiments/descriptor.h"
#include "experiments/executor.h"
#include "experiments/plan.h"
#include "experiments/shared_queue.h"
#include "experiments/store/store.h"

namespace limen::experiments {

struct RunnerOptions {
  int shardIndex = 1, shardCount = 1;                     ///< only runs of this shard; index from 1
  bool failFast = false;                                  ///< stop after the batch with the first failed run
  bool retryDied = false;                                 ///< also runs whose process died twice
  double pollSeconds = 0.2;                               ///< between checks of runs held by another sweep
  const std::unordered_set<std::string>* only = nullptr;  ///< keys; null: all
  /// Where to begin, as a share of the plan: tasks that begin at different scenes do not all wait for the
  /// same reference. From there on to the end, then what is before.
  double begin = 0.0;
  SharedQueue* queue = nullptr;  ///< what is measured is taken from it, batch by batch; null: all
};

/// Notified of progress while a sweep runs. Counts refer to the shard.
class SweepObserver {
 public:
  virtual ~SweepObserver() = default;
  virtual void begin(size_t planned, size_t alreadyDone) = 0;
  virtual void measuring(const PlannedRun& first, size_t batchSize) = 0;
  virtual void finished(const PlannedRun& run, const store::Run& row) = 0;
  /// A run finished by another sweep in the meantime.
  virtual void doneElsewhere(const PlannedRun& run) = 0;
  virtual void waiting(size_t heldByOthers) = 0;
  /// A run that another task has taken from the queue: it is not planned here any more.
  virtual void leftToOther(const PlannedRun&) {}
};

/// The outcome of a sweep. planned = done + skipped + failed + left.
struct SweepTally {
  size_t planned = 0;
  size_t done = 0;     ///< measured now
  size_t skipped = 0;  ///< measured before, or meanwhile by another sweep
  size_t failed = 0;
  size_t left = 0;  ///< not attempted: interrupted or stopped by failFast
  bool interrupted = false;
};

/// Measures what the store does not have yet for the executor's device. Every run is claimed before and
/// committed as soon as it is finished; a batch is on the disk before the next begins; claims that are
/// not finished are given back, whatever happens. Runs that another live process holds are left to it and
/// waited for at the end. A run whose process died is tried once more, alone; after that it is failed, here
/// and in later calls, so that a file that kills the program does not keep a sweep from its end. Throws Error
/// if store or executor cannot go on.
SweepTally runSweep(const Plan& plan, store::Store& results, Executor& executor,
                    const nlohmann::json& hostFacts, const RunnerOptions& options, SweepObserver& observer);

/// Stores the experiment, its whole plan (all shards, so that merged stores know what is missing) and the
/// descriptions of its names; or of the plan only some runs, where another store has all. Returns its id.
int64_t enterExperiment(const Descriptor& descriptor, const Plan& plan, store::Store& results,
                        const std::unordered_set<std::string>* only = nullptr);

/// Evaluates the descriptor's expectations over everything in the store from this plan for `device` ("":
/// whichever was measured last, done before failed), and stores the result.
std::vector<store::Expectation> evaluateExpectations(const Descriptor& descriptor, const Plan& plan,
                                                     int64_t experiment, const std::string& device,
                                                     store::Store& results);

}  // namespace limen::experiments
