// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "analysis/correlations/cluster_bootstrap.h"
#include "analysis/output/result.h"

namespace limen::analysis {

std::string levelText(double level);  ///< "95 %"
/// level, bootstrap_over, samples, seed; the last three only where rows were resampled.
void addBootstrapFacts(Section& out, const std::string& over, const BootstrapSetting& setting);
/// What is to be said of intervals of a bootstrap over clusters; "" for none.
std::string bootstrapNote(const std::string& cluster);
/// Interval of a bootstrap, if there is one.
std::optional<Interval> boundsOf(const std::optional<ResampledInterval>& bootstrap);

inline constexpr const char* kDashNote = "-: cannot be told, or of no width, which is no certainty";

}  // namespace limen::analysis
