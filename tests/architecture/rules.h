// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace limen::architecture {

/// One line each: where, what, and which rule it breaks. Empty: all is well.
using Violations = std::vector<std::string>;

/// Every #include "..." in the .h, .cpp and .glsl files of the modules under `root` goes in an allowed
/// direction and to a public header; modules without GL include no GL header.
Violations checkIncludes(const std::filesystem::path& root);

/// Every .h, .cpp and .glsl file of the modules and tests under `root` starts with the licence line.
Violations checkLicenceLines(const std::filesystem::path& root);

/// No source file of the modules under `root` opens a file for writing by itself: what is written goes
/// through experiments/base/part_file.h, which never leaves half a file and never replaces an input.
Violations checkFileWriting(const std::filesystem::path& root);

/// Every .glsl file under `root` is listed in a CMakeLists.txt: builds that embed shaders know no others, and
/// those that read them from the tree would not notice.
Violations checkShaderLists(const std::filesystem::path& root);

/// The dependency table of a page (rows "| `package` | when | reason |") says what packages.txt says, in its
/// order.
Violations checkPackageTable(const std::string& page, const std::string& packages);

struct Target {
  std::string folder;           ///< relative to the root; "." for the root
  std::set<std::string> links;  ///< targets and libraries
};

/// Reads lines "name|folder|link;link;...", in which links may be generator expressions.
std::map<std::string, Target> readTargets(const std::string& listing);

/// The targets of one module link those of others in an allowed direction only, and nothing links a test.
Violations checkTargets(const std::map<std::string, Target>& targets);

/// Everything that `name` links, directly or through targets of the list.
std::set<std::string> linkClosure(const std::map<std::string, Target>& targets, const std::string& name);

}  // namespace limen::architecture
