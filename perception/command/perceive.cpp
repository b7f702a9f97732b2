// SPDX-License-Identifier: BSD-3-Clause
#include "perception/command/perceive.h"

#include "experiments/base/build_facts.h"
#include "experiments/base/error.h"
#include "experiments/base/image.h"
#include "experiments/base/program.h"
#include "perception/command/commands.h"

namespace limen::perception {

int perceiveMain(int argc, char** argv) {
  CLI::App app("Predicts what a viewer sees: vision models, threshold maps, popping, image differences.",
               "limen-perceive");
  app.set_version_flag("--version", versionText("limen-perceive"));
  app.require_subcommand(1);
  int exitCode = kExitSuccess;
  ImageLimits limits = imageLimits();
  // Before the command, or among its own options.
  app.fallthrough();
  app.add_option_function<double>(
         "--max-megapixels",
         [limits](double megapixels) mutable {
           limits.megapixels = limits.alwaysMegapixels = megapixels;
           setImageLimits(limits);
         },
         "Read images of up to so many megapixels, however few bytes they have (default: 256, and few for a "
         "small file)")
      ->check(CLI::Range(0.0, 1e5))
      ->trigger_on_parse();
  addModelCommands(app, exitCode);
  addImageCommands(app, exitCode, {argv, argv + argc});
  return runProgram(app, argc, argv, exitCode);
}

}  // namespace limen::perception
