// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "experiments/base/problems.h"
#include "experiments/descriptor.h"

namespace limen::experiments {

/// Reads the list under `expect` of a descriptor whose scenes, techniques and metrics have been read. Names
/// that the descriptor does not have become problems.
std::vector<ExpectationStatement> readExpectations(const YamlNode& node, const Descriptor& descriptor,
                                                   const Catalogue& catalogue, Problems& problems);

}  // namespace limen::experiments
