// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "experiments/submission.h"
#include "experiments/sweep_options.h"

namespace limen::experiments {

/// Enters a folder that a submission names. Throws Error.
void enterFolder(const std::string& folder);

/// The options that a submission was made with.
SweepOptions optionsOf(const Submission& submission, SweepOptions options);

/// The call that measures a task's share and ends with this process. `device`: "" for the submission's.
std::vector<std::string> measuringCall(const Submission& submission, int task, const std::string& device);

/// Allows a task's process to be started again as long as runs get finished in between.
class Restarts {
 public:
  explicit Restarts(std::string store) : store_(std::move(store)) {}
  bool operator()();

 private:
  std::string store_;
  size_t finished_ = 0;
  int vain_ = 0;
};

}  // namespace limen::experiments
