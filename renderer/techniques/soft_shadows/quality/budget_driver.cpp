// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/quality/budget_driver.h"

#include "renderer/techniques/soft_shadows/quality/frame_time_budget.h"
#include "renderer/techniques/soft_shadows/quality/masking_budget.h"
#include "renderer/techniques/soft_shadows/quality/painted_budget.h"
#include "renderer/techniques/soft_shadows/quality/perceptual_budget.h"
#include "renderer/techniques/soft_shadows/quality/radial_budget.h"

namespace limen::techniques {

std::unique_ptr<BudgetDriver> makeBudgetDriver(const BudgetSettings& settings) {
  return std::visit(
      [](const auto& chosen) -> std::unique_ptr<BudgetDriver> {
        if constexpr (std::is_same_v<decltype(chosen), const UniformBudget&>)
          return nullptr;
        else
          return makeBudgetDriver(chosen);
      },
      settings);
}

std::vector<Quantity> budgetQuantities() { return frameTimeQuantities(); }

void setRoots(const gl::Program& program, const BudgetRange& range) {
  program.set("leastRoot", range.leastRoot());
  program.set("mostRoot", range.mostRoot());
}

}  // namespace limen::techniques
