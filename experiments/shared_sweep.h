// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "experiments/sweep.h"
#include "experiments/sweep_steps.h"

namespace limen::experiments {

/// limen submit.
int submitSweeps(const SweepProgram& program, const SweepOptions& options);

/// limen sweep --gpus: one process a device on shares of the plan, then what a sweep ends with.
int sweepOnDevices(const SweepProgram& program, const SweepOptions& options);

/// What the scripts of submit call. A task keeps the process alive that measures its share; merging joins
/// the stores, submits what tasks left behind, and ends the sweep.
int keepTask(const SweepOptions& options);
int mergeTasks(const SweepProgram& program, const SweepOptions& options);

/// The options of the process that measures a task's share; enters the folder that the sweep was submitted
/// from.
SweepOptions optionsOfTask(const SweepOptions& options);

/// What a process does that opens a device before it is known what to measure there (device_process.h): says
/// which device it is and waits. Returns the options of the process that measures a task's share; none: it
/// has nothing to do.
std::optional<SweepOptions> standBy(const SweepProgram& program, const SweepOptions& options);

/// limen status.
int showStatus(const SweepOptions& options);

}  // namespace limen::experiments
