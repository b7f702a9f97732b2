// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "experiments/base/image.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {

/// Discontinuities between levels of quality produced by a technique, without a reference: how much a pixel's
/// visibility would change with its neighbour's choice of level, while its receiver, search area and
/// everything else stay its own. An error against a reference mixes this with the coarseness of the levels.
///
/// Two channels each, row 0 at the top: visibility of the pixel by the choice that a pixel made, itself
/// (`own`), the one on its right or the one below, which counts only where the choices differ; and that
/// choice, as a level between two integer ones, equal if the same levels have the same weights. -1 for a
/// choice: the pixel needed no processing, or its neighbour needed none or lies on another surface.
struct LevelSteps {
  Image own, right, below;
};

/// The line between neighbouring points of one surface has at most this sine (15 degrees) to the tangent
/// plane of either; steps to another surface exceed it unless both are seen edge-on.
inline constexpr double kSurfaceSlope = 0.25881904510252074;

/// Of the pairs of neighbours (right and below) on one surface that both needed processing:
///   level_step_max, level_step_p99: the largest change of visibility, and the one that 99 % of the pairs
///   whose choices differ do not exceed (nearest rank); 0 if none differ
///   level_step_mean: mean over all pairs, those of equal choices counting as 0
///   level_changes_per_px: pairs whose choices differ for each processed pixel, at most 2
/// A blend has a small change at nearly every pair, a hard choice a large one at few: compare the largest or
/// level_step_p99, since the sum along a path over the image is about the same for both. Empty if some
/// visibility is not finite, that is, beyond a software renderer's limits.
std::vector<Counter> levelStepCounters(const LevelSteps& steps);
/// What they mean.
std::vector<Quantity> levelStepQuantities();

}  // namespace limen::techniques
