// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace limen {

/// Names and titles of the YAML files in a folder, by name. Throws Error if one cannot be read.
std::vector<std::pair<std::string, std::string>> shippedFiles(const std::string& folder);

/// Path of a file, or of the shipped one of this name. `kind` is what they are: "protocol". Throws Error with
/// the nearest name.
std::string findShipped(const std::string& nameOrPath, const std::string& folder, const std::string& kind);

}  // namespace limen
