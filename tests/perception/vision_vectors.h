// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace limen::perception {

/// The functions that reference values exist for, by the name in their table. Arguments as there, those left
/// out at the end missing. A library that adds one of its own adds its line here.
using VectorFunction = std::function<double(const std::vector<double>&)>;
const std::map<std::string, VectorFunction>& vectorFunctions();

}  // namespace limen::perception
