// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace limen::perception {

/// Each adds one subcommand; `words` is the command line as typed, which is part of results.
void addCompareCommand(CLI::App& app, int& exitCode, const std::vector<std::string>& words);
void addThresholdCommand(CLI::App& app, int& exitCode, const std::vector<std::string>& words);
void addPopCommand(CLI::App& app, int& exitCode, const std::vector<std::string>& words);
void addVideoCommand(CLI::App& app, int& exitCode);

}  // namespace limen::perception
