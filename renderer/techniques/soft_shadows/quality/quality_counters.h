// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/techniques/soft_shadows/pixel_counts.h"

namespace limen::techniques {

/// Figures of Schwarz 2009, table 5.1, over the processed pixels:
///   examined_per_px, examined_sd: mean and standard deviation of the micro-occluders examined
///   budget_per_px: mean of the budgets; 0 if no processed pixel has a limit
///   examined_per_budget: mean of those over the pixel's budget; 0 if no processed pixel has a limit
/// The thesis's budget limits what a search area holds, so that is counted, not the blocking part of it.
/// `budgets` has one channel, 0: no limit; null: `budget` everywhere.
std::vector<Counter> qualityCounters(const PixelCounts& counted, const Image* budgets, int64_t budget);
/// What they mean.
std::vector<Quantity> qualityQuantities();

}  // namespace limen::techniques
