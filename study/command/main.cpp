// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/build_facts.h"
#include "experiments/base/program.h"
#include "study/command/commands.h"

int main(int argc, char** argv) {
  using namespace limen;
  CLI::App app("Studies with viewers: runs and simulates popping studies, exports the answers.",
               "limen-study");
  app.set_version_flag("--version", versionText("limen-study"));
  app.require_subcommand(1);
  study::Run run{{argv, argv + argc}};
  study::addProtocolCommand(app, run);
  study::addRunCommand(app, run);
  study::addSessionsCommand(app, run);
  study::addExportCommand(app, run);
  study::addSimulateCommand(app, run);
  study::addPowerCommand(app, run);
  study::addPredictCommand(app, run);
  study::addExampleCommand(app, run);
  study::addStimuliCommand(app, run);
  study::addTraceCommand(app, run);
  study::addTimingCommand(app, run);
  study::addCalibrateCommand(app, run);
  return runProgram(app, argc, argv, run.exitCode);
}
