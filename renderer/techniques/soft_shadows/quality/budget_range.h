// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <string>

#include "experiments/base/error.h"
#include "experiments/base/parameter.h"
#include "renderer/gl/program.h"

namespace limen::techniques {

/// The budgets between which a driver's map lies: its own lower one, `<name>_budget`, and `budget`. Between
/// them it is the root, a count of micro-occluders per axis, that follows what the driver measures: error and
/// cost per axis go by it.
struct BudgetRange {
  int64_t least = 25, most = 256;

  /// `name` of the driver.
  static BudgetRange of(const ParameterValues& values, const std::string& name) {
    return {values.integer(name + "_budget"), values.integer("budget")};
  }
  /// The lower one; `meaning` ends the sentence "Micro-occluders allowed for a pixel ...".
  static Parameter parameter(const std::string& name, const std::string& meaning, const std::string& source) {
    return integerParameter(name + "_budget", 25, 1, 1 << 24, "",
                            "Micro-occluders allowed for a pixel " + meaning, source);
  }
  /// Throws Error where there is no way from one to the other.
  static void check(const ParameterValues& values, const std::string& name) {
    const BudgetRange range = of(values, name);
    if (range.most == 0)
      throw Error("a budget without limit leaves the map '" + name + "' no range", "budget",
                  "give 'budget' a number above 0, or budget_map: uniform");
    if (range.least > range.most)
      throw Error("'" + name + "_budget' is above 'budget', which is the most that a pixel may take",
                  name + "_budget", "give it a smaller number, or 'budget' a larger one");
  }
  float leastRoot() const { return static_cast<float>(std::sqrt(static_cast<double>(least))); }
  float mostRoot() const { return static_cast<float>(std::sqrt(static_cast<double>(most))); }
  /// Uniforms leastRoot and mostRoot.
  void configure(const gl::Program& program) const {
    program.set("leastRoot", leastRoot());
    program.set("mostRoot", mostRoot());
  }
};

}  // namespace limen::techniques
