// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/techniques/soft_shadows/quality/budget_driver.h"

namespace limen::techniques {

/// Budget that is reduced where the receivers' texture hides errors of a shadow. Source: Schwarz 2009,
/// section 5.2.3 and figure 5.4 (12^2, and 5^2 on a textured part), which does not say how the texture is
/// measured. (derived) Here the measure is the RMS contrast of the unshadowed picture, albedo times the
/// cosine towards the light: standard deviation over mean of its luminance among the receivers in a square
/// window. Up to `low_contrast` the budget is `plain`, from `high_contrast` on `masked`; in between the
/// square root falls linearly. An object in front of a surface of another brightness counts as contrast too:
/// an edge masks like texture.
std::unique_ptr<BudgetDriver> makeBudgetDriver(const MaskingBudget& settings);

}  // namespace limen::techniques
