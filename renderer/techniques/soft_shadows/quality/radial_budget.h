// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/techniques/soft_shadows/quality/budget_driver.h"

namespace limen::techniques {

/// Budget that falls from `centre` at a centre to `rim` at the rim, the same in every frame. Its square root,
/// the number of micro-occluders per axis, is linear in the distance. Source: Schwarz 2009, figure 5.5 d,
/// which uses 12^2 in the centre and 5^2 at the left and right borders.
std::unique_ptr<BudgetDriver> makeBudgetDriver(const RadialBudget& settings);

}  // namespace limen::techniques
