// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace limen {

/// Facts about this machine, build and invocation, for store::Environment::facts: cpu, cores, memory_bytes,
/// os, kernel, compiler, build_type, libraries, commit (of the built source tree, with "-dirty" if it had
/// changes), command, working_directory (relative to `root`), time (UTC). What cannot be determined is
/// "unknown". An executor adds its GPU's facts.
nlohmann::json environmentFacts(const std::vector<std::string>& command, const std::string& root);

/// Words as a shell would read them back.
std::string quoteCommand(const std::vector<std::string>& words);

}  // namespace limen
