// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/quality/budget_driver.h"

#include "experiments/base/error.h"
#include "renderer/techniques/soft_shadows/quality/frame_time_budget.h"
#include "renderer/techniques/soft_shadows/quality/masking_budget.h"
#include "renderer/techniques/soft_shadows/quality/painted_budget.h"
#include "renderer/techniques/soft_shadows/quality/perceptual_budget.h"
#include "renderer/techniques/soft_shadows/quality/radial_budget.h"

namespace limen::techniques {
namespace {

constexpr const char *kBudgetMap = "budget_map", *kUniform = "uniform";

/// Null for the uniform budget.
const BudgetDriverInfo* named(const std::string& name) {
  for (const BudgetDriverInfo& driver : budgetDrivers())
    if (driver.name == name) return &driver;
  return nullptr;
}

const BudgetDriverInfo* chosen(const ParameterValues& values) { return named(values.text(kBudgetMap)); }

std::vector<BudgetDriverInfo> allDrivers() {
  std::vector<BudgetDriverInfo> all = {
      radialBudgetInfo(),
      maskingBudgetInfo(),
      paintedBudgetInfo(),
      perceptualBudgetInfo(),
  };
  // Takes any of the above as its base.
  all.push_back(frameTimeBudgetInfo(all));
  return all;
}

}  // namespace

const std::vector<BudgetDriverInfo>& budgetDrivers() {
  static const std::vector<BudgetDriverInfo> kDrivers = allDrivers();
  return kDrivers;
}

std::vector<Parameter> budgetParameters() {
  std::vector<std::string> names = {kUniform};
  for (const BudgetDriverInfo& driver : budgetDrivers()) names.push_back(driver.name);
  std::vector<Parameter> all = {choiceParameter(
      kBudgetMap, kUniform, names,
      "What gives each pixel its budget: the same for all, or an image made by a driver, which "
      "starts from 'budget'",
      "Schwarz 2009, section 5.2.1")};
  for (const BudgetDriverInfo& driver : budgetDrivers())
    all.insert(all.end(), driver.parameters.begin(), driver.parameters.end());
  return all;
}

void checkBudget(const ParameterValues& values) {
  const BudgetDriverInfo* driver = chosen(values);
  const BudgetDriverInfo* base = driver && driver->base ? named(driver->base(values)) : nullptr;
  for (const BudgetDriverInfo& other : budgetDrivers()) {
    if (&other == driver || &other == base) continue;
    for (const Parameter& parameter : other.parameters)
      if (values.all().at(parameter.name) != parameter.defaultValue)
        throw Error("'" + parameter.name + "' is about another budget map", parameter.name,
                    "leave it out, or give budget_map: " + other.name);
  }
  for (const BudgetDriverInfo* used : {driver, base})
    if (used && used->check) used->check(values);
}

bool hasBudgetMap(const ParameterValues& values) { return chosen(values) != nullptr; }

std::unique_ptr<BudgetDriver> makeBudgetDriver(const ParameterValues& values) {
  return makeBudgetDriver(values.text(kBudgetMap), values);
}

std::unique_ptr<BudgetDriver> makeBudgetDriver(const std::string& name, const ParameterValues& values) {
  const BudgetDriverInfo* driver = named(name);
  return driver ? driver->make(values) : nullptr;
}

}  // namespace limen::techniques
