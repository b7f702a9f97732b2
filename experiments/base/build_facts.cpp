// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/build_facts.h"

#include "generated_build_facts.h"

namespace limen {

std::string projectVersion() { return generated::kProjectVersion; }
std::string buildCommit() { return generated::kCommit; }
std::string buildType() { return generated::kBuildType; }

std::string versionText(const std::string& program) {
  return program + " " + projectVersion() + " (commit " + buildCommit() + ")";
}

}  // namespace limen
