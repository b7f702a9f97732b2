// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <utility>
#include <vector>

namespace CLI {
class App;
}

namespace limen::analysis {

/// Subcommands about studies, each with what runs it once it was parsed; that throws Error.
using StudyCommands = std::vector<std::pair<CLI::App*, std::function<void()>>>;
StudyCommands addStudyCommands(CLI::App& app);

}  // namespace limen::analysis
