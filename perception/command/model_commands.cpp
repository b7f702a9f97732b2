// SPDX-License-Identifier: BSD-3-Clause
#include "perception/command/commands.h"

namespace limen::perception {

void addModelCommands(CLI::App&, int&) {}

}  // namespace limen::perception
