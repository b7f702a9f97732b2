// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/submission.h"

namespace limen::experiments {

/// A job, or one task of a job array, as Slurm lists it.
struct SlurmTask {
  std::string job;     ///< its number
  int index = 0;       ///< within the array; 0: it is not of an array
  bool merge = false;  ///< the job that merges
  std::string state;   ///< PENDING, RUNNING, COMPLETED, FAILED, NODE_FAIL, CANCELLED, ...
  std::string reason, nodes;
  std::string array;  ///< number of the array that it is of, as dependencies name it
};

/// Whether the state is one that ends by itself: waiting or at work.
bool isActive(const SlurmTask& task);

/// A call of sbatch and the script that it submits. No user's text is in the script, whose only command is
/// exec "$@": names reach it as arguments.
struct SlurmJob {
  std::vector<std::string> call;
  std::string scriptPath, script;
};

/// Refuses options of sbatch that submit sets itself, and those that would run other text as a script.
void checkSlurmOptions(const std::vector<std::string>& options);
/// "64" or "64%8" as numbers of tasks and, or 0, of those that run at once. Throws Error.
std::pair<int, int> readArray(const std::string& text);

/// Throws Error for a folder that logs of jobs cannot lie in.
void requireSlurmName(const std::string& folder);

SlurmJob arrayJob(const Submission& submission);
/// Begins when the array has ended in whatever way; `array` is its number.
SlurmJob mergeJob(const Submission& submission, const std::string& array);

/// Writes the scripts.
void writeScript(const SlurmJob& job);
/// Throws Error that names the package where there is no sbatch.
void requireSlurm();
/// Submits and returns the job's number. Throws Error with what sbatch says.
std::string submitJob(const SlurmJob& job);

/// What Slurm knows of the jobs of these submissions, by name; those that ended some minutes ago are
/// forgotten. None if Slurm is not here or does not answer.
std::optional<std::vector<SlurmTask>> listJobs(const Submission& submission);

}  // namespace limen::experiments
