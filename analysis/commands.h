// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace limen::analysis {

// Each adds its subcommand; the callback does the work and throws Error for bad input.
void addFitCommand(CLI::App& app);

}  // namespace limen::analysis
