// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>

#include "experiments/submission.h"

namespace limen::experiments {

/// How far the tasks of a submission on this host are: a bar on a terminal, elsewhere a line now and then.
class ProgressLine {
 public:
  ProgressLine(const Submission& submission, size_t planned) : submission_(submission), planned_(planned) {}
  void show();
  /// Leaves the terminal's line.
  void end();

 private:
  const Submission& submission_;
  size_t planned_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now(), shown_{};
};

}  // namespace limen::experiments
