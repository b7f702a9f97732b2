// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "base/build_facts.h"
#include "base/error.h"
#include "base/text.h"
#include "perception/command/commands.h"

int main(int argc, char** argv) {
  CLI::App app("Says what a viewer sees: vision models, threshold maps, popping, image differences.",
               "limen-perceive");
  app.set_version_flag("--version", limen::versionText("limen-perceive"));
  app.require_subcommand(1);
  int exitCode = limen::kExitSuccess;
  limen::perception::addModelCommands(app, exitCode);
  limen::perception::addImageCommands(app, exitCode, {argv, argv + argc});

  // CLI11 would only say that a subcommand is missing.
  std::vector<std::string> commands;
  for (const CLI::App* command : app.get_subcommands({})) commands.push_back(command->get_name());
  if (argc > 1 && argv[1][0] != '-' &&
      std::find(commands.begin(), commands.end(), argv[1]) == commands.end()) {
    std::fprintf(stderr, "limen-perceive: no command '%s'; %s\n", argv[1],
                 limen::suggest(argv[1], commands).c_str());
    return limen::kExitBadInput;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? limen::kExitSuccess : limen::kExitBadInput;
  } catch (const limen::Error& error) {
    std::fprintf(stderr, "limen-perceive: %s\n", error.what());
    return limen::kExitBadInput;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "limen-perceive: %s\n", error.what());
    return limen::kExitFailedRuns;
  }
  return exitCode;
}
