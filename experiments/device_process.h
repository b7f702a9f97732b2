// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "experiments/base/child_process.h"
#include "experiments/executor.h"
#include "experiments/submission.h"

namespace limen::experiments {

/// A process that opens a device and then waits for what to measure on it. Opening one can take a driver
/// longer than planning a sweep: devices are opened once, side by side, and meanwhile the sweep is planned.
class DeviceProcess {
 public:
  /// Throws Error.
  explicit DeviceProcess(int device);

  /// Waits until the device is open. Throws Error if it cannot be used.
  const SweepDevice& device();

  /// Tells it to measure a task's share from now on; it does so as measuringCall() (tasks.h) would. Returns
  /// the process, whose end the caller waits for; 0: it has ended.
  pid_t measure(const Submission& submission, int task);

 private:
  int index_;
  std::optional<SweepDevice> device_;
  PipedProcess process_;
};

}  // namespace limen::experiments
