// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace CLI {
class App;
}

namespace limen::analysis {

/// Subcommands rates, anova, sdt, validate. Their callbacks throw Error.
void addStudyCommands(CLI::App& app);

}  // namespace limen::analysis
