// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "analysis/observer_statistics/anova.h"
#include "analysis/study/plan.h"

namespace limen::analysis {

using ConditionLevels = std::map<std::string, std::string>;  ///< factor -> level

/// Factors of a part that have two levels or more in these conditions, with those levels.
std::vector<NamedFactor> varyingFactors(const StudyPart& part,
                                        const std::vector<ConditionLevels>& conditions);
/// A condition's levels as indices into the factors; none if it lacks a factor.
std::optional<std::vector<size_t>> cellOf(const std::vector<NamedFactor>& factors,
                                          const ConditionLevels& condition);

}  // namespace limen::analysis
