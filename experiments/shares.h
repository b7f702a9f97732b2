// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "experiments/plan.h"

namespace limen::experiments {

/// Runs, as indices of a plan, that are measured together: as many of one scene and image size as the
/// descriptor interleaves (timing.batch). Sharing a sweep out never separates them, so that what is compared
/// is measured side by side on one device, as in a sweep that is not shared out.
using Batch = std::vector<size_t>;

/// The runs of `left` (indices of plan.runs, ascending) in batches.
std::vector<Batch> batchesOf(const Plan& plan, const std::vector<size_t>& left);

/// Deals batches to `count` tasks, back and forth, so that each gets as many (within one) of the cheap ones
/// at one end of the plan and the expensive ones at the other. Returns the numbers of batches for each task,
/// none of them empty if there are as many batches as tasks.
std::vector<std::vector<size_t>> deal(size_t batches, size_t count);

}  // namespace limen::experiments
