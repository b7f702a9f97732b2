// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "experiments/base/error.h"

namespace limen::study {

/// What a subcommand knows about its call and reports to main().
struct Run {
  std::vector<std::string> words;  ///< the command line as typed
  int exitCode = kExitSuccess;     ///< 1: it ran and something failed
};

// Each adds its subcommand; the callback does the work, sets Run::exitCode and throws Error for bad input.
void addCalibrateCommand(CLI::App& app, Run& run);
void addExampleCommand(CLI::App& app, Run& run);
void addExportCommand(CLI::App& app, Run& run);
void addPowerCommand(CLI::App& app, Run& run);
void addPredictCommand(CLI::App& app, Run& run);
void addProtocolCommand(CLI::App& app, Run& run);
void addRunCommand(CLI::App& app, Run& run);
void addSessionsCommand(CLI::App& app, Run& run);  ///< sessions, replay
void addSimulateCommand(CLI::App& app, Run& run);
void addStimuliCommand(CLI::App& app, Run& run);
void addTimingCommand(CLI::App& app, Run& run);
void addTraceCommand(CLI::App& app, Run& run);

}  // namespace limen::study
