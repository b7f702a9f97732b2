// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace limen {

/// Marks a file that this call of the program reads, so that nothing it writes can replace it. Whoever reads
/// what a user names does this: tables, stores, descriptors, protocols, images.
void protectInput(const std::string& path);

/// Throws Error if writing to `path` would replace a protected file under whatever name: another spelling, a
/// symbolic or a hard link. `where` is the option that named it; the path itself if left out.
void requireNoInput(const std::string& path, const std::string& where = {});

/// Absolute, links of all folders and of the file itself followed, whether or not the file exists yet.
std::string resolvedPath(const std::string& path);

}  // namespace limen
