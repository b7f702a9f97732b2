// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "experiments/base/catalogue.h"

namespace limen::experiments {

/// Text for `--list WHAT`: "" (everything, one line each), "scenes", "techniques", "metrics", or the name of
/// an entry (with its parameters). Throws Error on another name.
std::string describe(const Catalogue& catalogue, const std::string& what);
nlohmann::json describeAsJson(const Catalogue& catalogue, const std::string& what);

}  // namespace limen::experiments
