// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "experiments/store/store.h"

namespace limen::analysis {

/// Digits of a hash that are enough to name an experiment.
inline constexpr size_t kShortHash = 8;

/// The experiments of a store that `wanted` means: a title, a hash or its first kShortHash digits or more;
/// "": all. Throws Error: the store is empty, nothing is called so (with the nearest title), or several are.
std::vector<store::Experiment> chooseExperiments(const store::Store& store, const std::string& wanted);

}  // namespace limen::analysis
