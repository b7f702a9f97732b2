// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace CLI {
class App;
}

namespace limen::analysis {

// Each adds its subcommands; their callbacks do the work and throw Error for bad input.

void addReportCommand(CLI::App& app);  ///< report
void addSweepCommands(CLI::App& app);  ///< switch-distances
void addFitCommand(CLI::App& app);     ///< fit
void addStudyCommands(CLI::App& app);  ///< rates, thresholds, validate
void addAnovaCommand(CLI::App& app);
void addSdtCommand(CLI::App& app);
void addMixedCommand(CLI::App& app);

void addCorrelateCommand(CLI::App& app);  ///< correlate
void addScaleCommand(CLI::App& app);      ///< scale
void addPublishedCommand(CLI::App& app);  ///< published

}  // namespace limen::analysis
