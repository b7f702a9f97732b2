// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace limen::perception {

/// Each adds its subcommands; a subcommand's callback does the work, sets `exitCode` (0: success, 1: a limit
/// given with --fail-above is exceeded) and throws Error for bad input. `words` is the command line as typed.
void addModelCommands(CLI::App& app, int& exitCode);  ///< csf, tvi, masking, display
void addImageCommands(CLI::App& app, int& exitCode,
                      const std::vector<std::string>& words);  ///< threshold, pop, compare

}  // namespace limen::perception
