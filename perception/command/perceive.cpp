// SPDX-License-Identifier: BSD-3-Clause
#include "perception/command/perceive.h"

#include "experiments/base/build_facts.h"
#include "experiments/base/error.h"
#include "experiments/base/program.h"
#include "perception/command/commands.h"

namespace limen::perception {

int perceiveMain(int argc, char** argv) {
  CLI::App app("Predicts what a viewer sees: vision models, threshold maps, popping, image differences.",
               "limen-perceive");
  app.set_version_flag("--version", versionText("limen-perceive"));
  app.require_subcommand(1);
  int exitCode = kExitSuccess;
  addModelCommands(app, exitCode);
  addImageCommands(app, exitCode, {argv, argv + argc});
  return runProgram(app, argc, argv, exitCode);
}

}  // namespace limen::perception
