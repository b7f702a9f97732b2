// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "tests/architecture/rules.h"

namespace limen::architecture {

/// No `layout(... binding = N)` with a number, nor a define of a unit with one. `file` is named in
/// violations.
Violations checkLayouts(const std::string& file, const std::string& shader);

/// No call that binds a texture, image or block to a unit that is, or begins with, a number.
Violations checkBindCalls(const std::string& file, const std::string& source);

/// Constants of a header that C++ and GLSL share stay below what every driver grants: 8 image units, 16
/// texture units.
Violations checkUnits(const std::string& file, const std::string& header);

/// All .glsl files under `root`, all .cpp and .h files that bind for them, and all shared headers. Besides
/// the rules above: every header that a shader includes is listed in limen_shaders() of the nearest
/// CMakeLists.txt that has such a list, and no stage includes it first within an #if, as the reader takes a
/// file once.
Violations checkBindings(const std::filesystem::path& root);

/// The last of these alone, for the files that `read` gives by path: `shader` and what it includes.
Violations checkConditionalIncludes(const std::string& shader,
                                    const std::function<std::string(const std::string&)>& read);

}  // namespace limen::architecture
