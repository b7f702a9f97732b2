// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/output/result.h"
#include "analysis/statistics/interval.h"
#include "analysis/sweep/sweep.h"

namespace limen::analysis {

/// y = factor x^exponent, by least squares of ln y over ln x, each point weighted alike.
struct PowerLaw {
  double exponent = 0.0, factor = 0.0;
  std::optional<Interval> exponent95;  ///< Student's t with n - 2 degrees; none for two points
  double departure = 1.0;              ///< largest y / fitted y, or its inverse: 1.1 is 10 % off
};

/// None for fewer than two different x. Both numbers of every point are positive.
std::optional<PowerLaw> fitPowerLaw(const std::vector<std::pair<double, double>>& points);

/// How the report's y follows its x over runs that differ in nothing but the parameters that the descriptor's
/// `fit` names.
struct Scaling {
  std::string scene, technique;
  size_t series = 0;          ///< index into Sweep, of the first run
  std::string settings;       ///< what else tells the runs from others: "form patch_parallel"
  size_t n = 0, leftOut = 0;  ///< runs fitted, and runs with a value that is missing or not positive
  double xLow = 0.0, xHigh = 0.0;
  std::optional<PowerLaw> law;
};

/// The parameters that the descriptor's `fit` names.
std::vector<std::string> fittedOver(const Sweep& sweep);

/// In the order of their first runs; empty if the descriptor asks for none.
std::vector<Scaling> findScalings(const Sweep& sweep);

/// Table "scalings".
ResultTable tableOf(const Sweep& sweep, const std::vector<Scaling>& scalings);

}  // namespace limen::analysis
