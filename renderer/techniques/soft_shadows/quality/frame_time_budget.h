// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/techniques/soft_shadows/quality/budget_driver.h"

namespace limen::techniques {

/// Scales a budget, or another driver's map, so that the technique's own passes take `target_ms`: what a
/// FrameTimeController makes of the times of past frames. Source: Schwarz 2009, chapter 5 (an allotted frame
/// time), which leaves the loop open. What is timed are the passes that search and gather, not shadow map,
/// pyramid and the map of budgets, on which a budget has no effect. On a GPU by timestamps, a few frames
/// late; on a software renderer by wall time, for which frames wait (frame_stopwatch.h).
///
/// Budgets count whole micro-occluders per axis, and one more or less is a large step of the cost: unless
/// `dither` is off, that many pixels get the next larger count that the mean is right.
///
/// The product depends on how fast the machine is. Counters: budget_scale; frame_time_error_share (smoothed
/// time over what was asked for, less 1); frame_time_oscillations.
std::unique_ptr<BudgetDriver> makeBudgetDriver(const FrameTimeBudget& settings);

/// What that driver counts.
std::vector<Quantity> frameTimeQuantities();

}  // namespace limen::techniques
