// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace limen::analysis {

/// Whether a file is an SQLite database, which only a result store can be here; anything else is read as a
/// table of text. Throws Error if there is no such file or it cannot be read.
bool isDatabase(const std::string& path);

}  // namespace limen::analysis
