// SPDX-License-Identifier: BSD-3-Clause
#include "perception/command/image_commands.h"

#include "perception/command/commands.h"

namespace limen::perception {

void addImageCommands(CLI::App& app, int& exitCode, const std::vector<std::string>& words) {
  addThresholdCommand(app, exitCode, words);
  addPopCommand(app, exitCode, words);
  addCompareCommand(app, exitCode, words);
  addVideoCommand(app, exitCode);
}

}  // namespace limen::perception
