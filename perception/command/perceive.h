// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace limen::perception {

/// The program limen-perceive. Returns its exit code.
int perceiveMain(int argc, char** argv);

}  // namespace limen::perception
