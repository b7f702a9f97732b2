// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiments/runner.h"

namespace limen::experiments {

/// How far a task is, as it says in a small file that is replaced as a whole. A store that a process on
/// another host writes must not be opened: SQLite's locks do not reach that far on every file system.
struct TaskProgress {
  size_t planned = 0, done = 0, failed = 0;
  size_t holding = 0;                 ///< runs of the batch that is being measured
  double secondsEach = 0;             ///< per run so far; 0: unknown
  std::string host, at;               ///< where, and when it was written (UTC)
  std::vector<std::string> failures;  ///< the first few
};

/// Writes the file as runs finish, at most once a second, and when a batch begins.
std::unique_ptr<SweepObserver> makeProgressWriter(const std::string& path);

/// None if there is no such file yet or what is there is no progress.
std::optional<TaskProgress> readProgress(const std::string& path);

}  // namespace limen::experiments
