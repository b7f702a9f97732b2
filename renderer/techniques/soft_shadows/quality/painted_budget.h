// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/base/image.h"
#include "renderer/techniques/soft_shadows/quality/budget_driver.h"

namespace limen::techniques {

/// Budget from a painted image: black for `black`, white for `white`, the square root linear in between; the
/// same in every frame. Source: Schwarz 2009, section 5.2.1 ("importance as assigned by the user").
std::unique_ptr<BudgetDriver> makeBudgetDriver(const PaintedBudget& settings);

/// Weights 0..1 of a one-channel image at the frame's size: a tent filter with a radius of one pixel of the
/// coarser of the two images, so that every texel counts when the image shrinks; bilinear when it grows.
/// Throws Error for PaintedFit::Refuse.
Image paintedWeights(const Image& grey, glm::ivec2 sizePx, PaintedFit fit);

}  // namespace limen::techniques
