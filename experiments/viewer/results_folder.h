// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace limen::viewer {

/// Makes the folder where there is none. Throws Error if it cannot.
void makeFolder(const std::filesystem::path& folder);

/// A name in `folder` that is not taken: "STEM_001EXTENSION". Throws Error if there is none.
std::filesystem::path freshName(const std::filesystem::path& folder, const std::string& stem,
                                const std::string& extension);

}  // namespace limen::viewer
