// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>

#include "analysis/commands/commands.h"
#include "experiments/base/build_facts.h"
#include "experiments/base/error.h"
#include "experiments/base/program.h"

int main(int argc, char** argv) {
  CLI::App app("Says what sweeps and studies found. Needs no GPU.", "limen-analyse");
  app.set_version_flag("--version", limen::versionText("limen-analyse"));
  app.require_subcommand(1);
  limen::analysis::addReportCommand(app);
  limen::analysis::addSweepCommands(app);
  limen::analysis::addFitCommand(app);
  limen::analysis::addStudyCommands(app);
  limen::analysis::addAnovaCommand(app);
  limen::analysis::addSdtCommand(app);
  limen::analysis::addMixedCommand(app);
  limen::analysis::addCorrelateCommand(app);
  limen::analysis::addScaleCommand(app);
  limen::analysis::addPublishedCommand(app);
  return limen::runProgram(app, argc, argv, limen::kExitSuccess);
}
