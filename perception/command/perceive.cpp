// SPDX-License-Identifier: BSD-3-Clause
#include "perception/command/perceive.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "base/build_facts.h"
#include "base/error.h"
#include "base/text.h"
#include "perception/command/commands.h"

namespace limen::perception {
namespace {

/// Says in one line what the command line lacks.
void explain(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App* command = &app;
  for (const CLI::App* parsed : app.get_subcommands()) command = parsed;
  const std::vector<std::string> rest = app.remaining(true);
  if (error.get_exit_code() != static_cast<int>(CLI::ExitCodes::ExtrasError) || rest.empty()) {
    std::fprintf(stderr, "limen-perceive: %s; see --help\n", error.what());
    return;
  }
  std::string mend = "quote a pattern, so that the shell leaves it alone";
  if (rest.front().rfind("-", 0) == 0) {
    std::vector<std::string> known;
    for (const CLI::Option* option : command->get_options())
      for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    mend = suggest(rest.front(), known);
  }
  std::fprintf(stderr, "limen-perceive: unknown argument '%s'; %s\n", rest.front().c_str(), mend.c_str());
}

}  // namespace

int perceiveMain(int argc, char** argv) {
  CLI::App app("Says what a viewer sees: vision models, threshold maps, popping, image differences.",
               "limen-perceive");
  app.set_version_flag("--version", versionText("limen-perceive"));
  app.require_subcommand(1);
  int exitCode = kExitSuccess;
  addModelCommands(app, exitCode);
  addImageCommands(app, exitCode, {argv, argv + argc});

  // CLI11 would only say that a subcommand is missing.
  std::vector<std::string> commands;
  for (const CLI::App* command : app.get_subcommands({})) commands.push_back(command->get_name());
  if (argc > 1 && argv[1][0] != '-' &&
      std::find(commands.begin(), commands.end(), argv[1]) == commands.end()) {
    std::fprintf(stderr, "limen-perceive: no command '%s'; %s\n", argv[1],
                 suggest(argv[1], commands).c_str());
    return kExitBadInput;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    explain(app, error);
    return kExitBadInput;
  } catch (const Error& error) {
    std::fprintf(stderr, "limen-perceive: %s\n", error.what());
    return kExitBadInput;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "limen-perceive: %s\n", error.what());
    return kExitFailedRuns;
  }
  return exitCode;
}

}  // namespace limen::perception
