// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "analysis/relations/cluster_bootstrap.h"

namespace limen::analysis {

/// What the results on relations say alike.

std::string levelText(double level);  ///< "95 %"
/// "Bootstrap: percentile intervals, ..." with a line feed; "" for none.
std::string bootstrapText(const std::string& cluster, const BootstrapSetting& setting);
nlohmann::json bootstrapJson(const std::string& cluster, const BootstrapSetting& setting);
/// Interval of a bootstrap, if there is one.
std::optional<Interval> boundsOf(const std::optional<ResampledInterval>& bootstrap);
std::optional<double> lowOf(const std::optional<Interval>& interval);
std::optional<double> highOf(const std::optional<Interval>& interval);
/// "trials=2, 24 rows" for a heading; `name` may be empty.
std::string groupText(const std::string& name, const std::string& rest);

}  // namespace limen::analysis
