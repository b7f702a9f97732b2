// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/program.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "experiments/base/error.h"
#include "experiments/base/failure.h"
#include "experiments/base/interrupt.h"
#include "experiments/base/printable.h"
#include "experiments/base/standard_output.h"
#include "experiments/base/text.h"

namespace limen {
namespace {

/// The subcommand that was called, at any depth.
const CLI::App* parsedCommand(const CLI::App* app) {
  while (true) {
    const std::vector<CLI::App*> parsed = app->get_subcommands();
    if (parsed.empty()) return app;
    app = parsed.back();
  }
}

/// Prints one line that says what is missing on the command line.
void explain(const CLI::App& app, const CLI::ParseError& error) {
  const std::string& program = app.get_name();
  const std::vector<std::string> rest = app.remaining(true);
  if (error.get_exit_code() != static_cast<int>(CLI::ExitCodes::ExtrasError) || rest.empty()) {
    std::fprintf(stderr, "%s: %s; see --help\n", program.c_str(), printable(error.what()).c_str());
    return;
  }
  std::string hint = "quote a pattern to keep the shell from expanding it";
  if (rest.front().rfind("-", 0) == 0) {
    std::vector<std::string> known;
    for (const CLI::Option* option : parsedCommand(&app)->get_options())
      for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    hint = suggest(rest.front(), known);
  }
  std::fprintf(stderr, "%s: unknown argument '%s'; %s\n", program.c_str(), printable(rest.front()).c_str(),
               printable(hint).c_str());
}

int parseAndRun(CLI::App& app, int argc, char** argv, const int& exitCode) {
  const std::string& program = app.get_name();
  // CLI11 would only say that a subcommand is missing.
  std::vector<std::string> commands;
  for (const CLI::App* command : app.get_subcommands({})) commands.push_back(command->get_name());
  if (argc > 1 && argv[1][0] != '-' && !commands.empty() &&
      std::find(commands.begin(), commands.end(), argv[1]) == commands.end()) {
    std::fprintf(stderr, "%s: no command '%s'; %s\n", program.c_str(), printable(argv[1]).c_str(),
                 suggest(argv[1], commands).c_str());
    return kExitBadInput;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    explain(app, error);
    return kExitBadInput;
  } catch (...) {
    return reportFailure(program);
  }
  return exitCodeAfter(exitCode);
}

}  // namespace

int runProgram(CLI::App& app, int argc, char** argv, const int& exitCode) {
  app.name(calledName(app.get_name()));
  return afterStandardOutput(app.get_name(), parseAndRun(app, argc, argv, exitCode));
}

}  // namespace limen
