// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace limen {

/// Parses a program's command line and runs the subcommand that it names (callbacks do the work and set
/// `exitCode`). Returns what main() returns. Errors are reported in one line, an unknown command or option
/// with the nearest known one. Error and anything caused by the input gives kExitBadInput, other exceptions
/// kExitFailedRuns, and so does standard output that could not be written. After SIGINT or SIGTERM
/// (interrupt.h) it is 128 plus the signal.
int runProgram(CLI::App& app, int argc, char** argv, const int& exitCode);

}  // namespace limen
