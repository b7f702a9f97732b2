// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "experiments/base/quantity.h"
#include "experiments/executor.h"

namespace limen::experiments {

/// Name under which a metric's value is stored: the metric's own, followed by its non-default values if a
/// descriptor lists the metric more than once ("rmse", "rmse_penumbra"). `declared`: the metric's parameters.
std::string measurementName(const Configuration& metric, const std::vector<Configuration>& all,
                            const std::vector<Parameter>& declared);

/// Names of all that a metric stores: its own, or one for each of its `figures`.
std::vector<std::string> measurementNames(const Configuration& metric, const std::vector<Configuration>& all,
                                          const std::vector<Parameter>& declared,
                                          const std::vector<Quantity>& figures);

/// After a metric's name: the noise that the reference leaves in a difference of two values of it.
inline constexpr const char* kNoiseSuffix = "_noise";

/// Title of the same value: the metric's, distinguished in the same way ("RMSE, penumbra").
std::string measurementTitle(const std::string& title, const Configuration& metric,
                             const std::vector<Configuration>& all, const std::vector<Parameter>& declared);

}  // namespace limen::experiments
