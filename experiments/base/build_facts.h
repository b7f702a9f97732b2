// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace limen {

/// Version of the project: "0.1.0".
std::string projectVersion();
/// Commit of the built source tree, 40 digits, with "-dirty" if it had changes; "unknown" outside a clone.
std::string buildCommit();
/// CMake's build type: "Release".
std::string buildType();
/// "limen-sweep 0.1.0 (commit ...)": what --version prints.
std::string versionText(const std::string& program);

}  // namespace limen
