// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>
#include <vector>

#include "experiments/gathering.h"
#include "experiments/submission.h"
#include "experiments/sweep.h"
#include "experiments/sweep_steps.h"

namespace limen::experiments {

/// The sweeps of one store, which are shared out together.
struct SweepGroup {
  std::string store;
  std::vector<PlannedSweep> sweeps;
};

/// Plans the sweeps of a command. Throws Error for whatever would go wrong later, before anything is written.
std::vector<SweepGroup> groupedSweeps(const SweepProgram& program, const SweepOptions& options);

std::set<std::string> keysOf(const SweepGroup& group);

/// Of `keys` those that are neither done nor, unless `retryDied`, given up.
std::set<std::string> leftOf(std::set<std::string> keys, const Facts& facts, bool retryDied);

/// Keys for each task: batches of what is left, dealt to at most `count` tasks.
std::vector<std::vector<std::string>> dealKeys(const SweepGroup& group, const std::set<std::string>& left,
                                               size_t count);

/// What is known of a submission before it is written.
Submission describeSubmission(const SweepGroup& group, const SweepOptions& options);

/// Puts the whole plans into the store, so that it knows what is missing.
void enterPlans(const SweepGroup& group);

/// Expectations, reports and summaries of a group whose runs are all in its store. `now` are the keys that
/// were measured for this call. Returns the exit code.
int endGroup(const SweepGroup& group, const std::set<std::string>& now, const std::string& program,
             bool report, const std::string& note, const SweepOutput& output);

/// "1 run", "2 runs"
std::string describeCount(size_t number, const std::string& word);

}  // namespace limen::experiments
