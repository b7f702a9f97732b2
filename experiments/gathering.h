// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "experiments/store/store.h"
#include "experiments/submission.h"
#include "experiments/sweep_steps.h"

namespace limen::experiments {

/// How the best run of a key stands: one that is done before one that failed before one that is held.
struct RunFacts {
  std::string status, device, error;
  bool diedTwice = false;
};
using Facts = std::unordered_map<std::string, RunFacts>;  ///< by key

/// Of runs on devices whose name has `device` in it, in any case; of all if that is "" or an index.
Facts factsOf(const store::Store& results, const std::string& device = {});
/// Of runs on these devices.
Facts factsOf(const store::Store& results, const std::set<std::string>& devices);

/// Number of runs of a store that are done or failed; 0 if there is none yet.
size_t finishedIn(const std::string& store);

/// Whether jobs of a submission wait or work; on this host, whether the process that keeps its tasks running
/// lives. Throws Error if Slurm does not answer.
bool isActive(const Submission& submission);

/// Submissions that are active and not gathered yet.
std::vector<Submission> activeSubmissions(const std::string& store);
/// Their keys.
std::set<std::string> keysInQueue(const std::string& store);

/// Copies what a submission's tasks finished into the store; what is there already stays. A task's store that
/// cannot be read is said and left for later. The folders of both are locked by the caller.
void gatherSubmission(const Submission& submission, const std::string& store, const SweepOutput& output);

struct Gathered {
  bool unended = false;  ///< the last submission's sweep was not ended: expectations, report
};
/// gatherSubmission() of all that are not active and were not gathered before.
Gathered gather(const std::string& store, const SweepOutput& output);

/// Notes that expectations were judged and the report was written.
void markEnded(const Submission& submission, int exitCode);
bool isEnded(const Submission& submission);

std::string progressFile(const Submission& submission, int task);

}  // namespace limen::experiments
