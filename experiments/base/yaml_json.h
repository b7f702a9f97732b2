// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "experiments/base/yaml_tree.h"

namespace limen {

/// A tree as JSON: unquoted numbers, true and false as such, all other scalars as text, empty nodes as null.
nlohmann::json toJson(const YamlNode& node);

}  // namespace limen
