// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace limen {

/// To be called last by a program: `exitCode`, or kExitFailedRuns with a message if what was printed did not
/// reach standard output (a full disk).
int afterStandardOutput(const std::string& program, int exitCode);

}  // namespace limen
