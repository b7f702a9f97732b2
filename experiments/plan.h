// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "experiments/base/catalogue.h"
#include "experiments/descriptor.h"
#include "experiments/executor.h"

namespace limen::experiments {

/// A grid larger than this is a mistake, not an experiment.
inline constexpr uint64_t kMaxRuns = 100'000;

/// Every run of a descriptor, in a stable order: by image size, then by scene, then round-robin over the
/// technique entries, so that runs measured together use different techniques.
struct Plan {
  std::vector<PlannedRun> runs;
  /// Runs that share scene and image size are consecutive; [begin, end) of each such group.
  std::vector<std::pair<size_t, size_t>> groups;
  nlohmann::json published = nlohmann::json::array();  ///< see published.h
  store::Descriptions descriptions;                    ///< what the names in its runs mean
};

/// Throws Error naming file and line: too many runs (counted before expansion), a run planned
/// twice, an expectation or a row of a published table that no planned run matches.
Plan makePlan(const Descriptor& descriptor, const Catalogue& catalogue);

/// Runs whose key belongs to shard `index` of `count` (index from 1), as a mask over plan.runs. Every run
/// belongs to exactly one shard, whatever the descriptor's order.
std::vector<bool> shardMask(const Plan& plan, int index, int count);

/// "soft_shadows/bitmask pattern=regular_8, grid light_size=2, 640x480"
std::string describe(const PlannedRun& run);

/// The grid's size in words: "24 runs: 2 scenes x 3 techniques x 4 image sizes".
std::string describeSize(const Descriptor& descriptor, const Plan& plan);

}  // namespace limen::experiments
