// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <unordered_set>
#include <vector>

namespace limen::experiments {

/// The part of a submission that a task measures (submission.h).
struct TaskShare {
  std::unordered_set<std::string> keys;
  int task = 1, tasks = 1;
  std::string progressFile;
  std::string
      queueFile;  ///< of tasks that take runs from each other (SharedQueue); "": the keys are this one's
};

/// The options of `limen sweep` and its commands.
struct SweepOptions {
  enum class Command { Sweep, Merge, Submit, Status, Job };
  Command command = Command::Sweep;

  std::vector<std::string> descriptors;
  std::string store;  ///< "" for results/<descriptor>.sqlite
  int shardIndex = 1, shardCount = 1;
  bool dryRun = false, json = false, failFast = false, retryDied = false, noReport = false, features = false;
  std::optional<std::string> list;  ///< "" for everything
  std::string device;               ///< name or index of the GPU; "": the first that is one
  std::string gpus;                 ///< "all" or indices of GPUs that share the sweep; "": one process
  std::string references;           ///< folder of reference products; "": beside the store
  std::string root;  ///< source tree with experiments/features.yaml and experiments/descriptors

  std::string mergeOut;
  std::vector<std::string> mergeIn;

  std::string array;                      ///< of submit: "64", "64%8"
  std::vector<std::string> slurmOptions;  ///< of submit: options of sbatch, after --
  std::vector<std::string> shown;         ///< of status: stores and descriptors

  std::string jobVerb, jobFolder;  ///< of job: what it does in which folder of a submission
  int jobTask = 0;                 ///< 0: what Slurm says
  int jobParent = 0;               ///< process to end with; 0: none
  std::optional<TaskShare> share;  ///< measured instead of everything
};

/// Options, or the exit code of a call that was already answered (--help, --version) or refused.
struct ParsedOptions {
  SweepOptions options;
  std::optional<int> exitCode;
};

ParsedOptions parseOptions(int argc, char** argv, const std::string& program);

}  // namespace limen::experiments
