// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/techniques/soft_shadows/quality/budget_driver.h"

namespace limen::techniques {

/// Budget that keeps errors of coarse micro-occluders below what a viewer can see. Source: Schwarz 2009,
/// section 5.2.1 ("derived by perceptually motivated algorithms"), with the threshold map of section 9.4; how
/// the two are combined is left open there and (derived) here:
///
/// A search area holds what can lie in front of the light; divided into r micro-occluders per axis, each
/// covers 1 / r of the light's extent. A shadow's edge is then misplaced by some part c of that, and the
/// visibility wrong by c / r. With the direct light's luminance D on the unshadowed surface, the pixel's is
/// wrong by D c / r. It stays below `thresholds` times the pixel's threshold T from
///   r = c D / (thresholds T)
/// on, clamped between the square roots of `least` and `most`. T is the threshold map of the
/// unshadowed picture (ambient and direct light) on `display`, with the map's default settings: a single map
/// (castleCSF, or as in the thesis), below which errors may be visible, or one combined from frequency bands.
///
/// That errors are proportional to 1 / r was measured: over sphere_grid, columns_hall, textured_ground and
/// foliage with maps of 256 texels, 95 % of the processed pixels of blended levels are within 1.9 / r of an
/// unlimited budget, for r from 3 to 16 (one integer level: 3.1 / r). Hence the default of c, 2.
std::unique_ptr<BudgetDriver> makeBudgetDriver(const PerceptualBudget& settings);

}  // namespace limen::techniques
