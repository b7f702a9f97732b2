// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/techniques/soft_shadows/quality/budget_driver.h"

namespace limen::techniques {

/// Scales a budget, or another driver's map, so that the technique's own passes take `target_ms`: a
/// FrameTimeController derives the scale from the times of past frames. Source: Schwarz 2009, chapter 5 (an
/// allotted frame time), which leaves the control loop open. The passes timed are those that search and
/// gather, not the shadow map, pyramid and budget map, which do not depend on the budget. On a GPU timestamps
/// are used, a few frames late; on a software renderer wall time, for which frames wait (frame_stopwatch.h).
///
/// Budgets count whole micro-occluders per axis, and one more or less is a large step of the cost: unless
/// `dither` is off, as many pixels get the next larger count as are needed for the right mean.
///
/// The product depends on how fast the machine is. Counters: budget_scale; frame_time_error_share (smoothed
/// time over target, minus 1); frame_time_oscillations.
std::unique_ptr<BudgetDriver> makeBudgetDriver(const FrameTimeBudget& settings);

/// The counters of that driver.
std::vector<Quantity> frameTimeQuantities();

}  // namespace limen::techniques
