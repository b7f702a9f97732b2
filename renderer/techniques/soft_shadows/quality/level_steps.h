// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "experiments/base/image.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {

/// Discontinuities between levels of quality as a technique makes them, without a reference: how far the
/// visibility of a pixel would change by its neighbour's choice of level alone, its receiver, search area and
/// all else staying its own. An error against a reference mixes that with how coarse the levels are.
///
/// Two channels each, row 0 at the top: visibility of the pixel by the choice that a pixel made, itself
/// (`own`), the one on its right or the one below, which counts only where the choices differ; and that
/// choice, as a level between two whole ones, equal where the same levels have the same weights. -1 for a
/// choice: the pixel needed no processing, or its neighbour did not or lies on another surface.
struct LevelSteps {
  Image own, right, below;
};

/// The line between neighbouring points of one surface has at most this sine (15 degrees) to the tangent
/// plane of either; steps to another surface exceed it unless both are seen edge-on.
inline constexpr double kSurfaceSlope = 0.25881904510252074;

/// Of the pairs of neighbours (right and below) on one surface that both needed processing:
///   level_step_max, level_step_p99: the largest change of visibility, and the one that 99 % of the pairs
///   whose choices differ do not exceed (nearest rank); 0 where none differ
///   level_step_mean: mean over all pairs, those of equal choices counting as 0
///   level_changes_per_px: pairs whose choices differ for each processed pixel, at most 2
/// A blend has a small change at nearly every pair, a hard choice a large one at few: compare the largest or
/// level_step_p99, since the sum along a way over the image is about the same for both.
/// Empty where some visibility is not finite, that is, out of a software renderer's reach.
std::vector<Counter> levelStepCounters(const LevelSteps& steps);
/// What they mean.
std::vector<Quantity> levelStepQuantities();

}  // namespace limen::techniques
