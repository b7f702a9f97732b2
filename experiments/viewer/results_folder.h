// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace limen::viewer {

/// Creates the folder if there is none. Throws Error on failure.
void makeFolder(const std::filesystem::path& folder);

/// A name in `folder` that is not taken: "STEM_001EXTENSION". Throws Error if there is none.
std::filesystem::path freshName(const std::filesystem::path& folder, const std::string& stem,
                                const std::string& extension);

}  // namespace limen::viewer
