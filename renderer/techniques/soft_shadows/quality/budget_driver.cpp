// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/quality/budget_driver.h"

#include "base/error.h"
#include "renderer/techniques/soft_shadows/quality/radial_budget.h"

namespace limen::techniques {
namespace {

constexpr const char *kBudgetMap = "budget_map", *kUniform = "uniform";

const BudgetDriverInfo* chosen(const ParameterValues& values) {
  for (const BudgetDriverInfo& driver : budgetDrivers())
    if (driver.name == values.text(kBudgetMap)) return &driver;
  return nullptr;
}

}  // namespace

const std::vector<BudgetDriverInfo>& budgetDrivers() {
  static const std::vector<BudgetDriverInfo> kDrivers = {
      radialBudgetInfo(),
  };
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
  for (const BudgetDriverInfo& other : budgetDrivers()) {
    if (&other == driver) continue;
    for (const Parameter& parameter : other.parameters)
      if (values.all().at(parameter.name) != parameter.defaultValue)
        throw Error("'" + parameter.name + "' is about another budget map", parameter.name,
                    "leave it out, or give budget_map: " + other.name);
  }
  if (driver && driver->check) driver->check(values);
}

bool hasBudgetMap(const ParameterValues& values) { return chosen(values) != nullptr; }

std::unique_ptr<BudgetDriver> makeBudgetDriver(const ParameterValues& values) {
  const BudgetDriverInfo* driver = chosen(values);
  return driver ? driver->make(values) : nullptr;
}

}  // namespace limen::techniques
