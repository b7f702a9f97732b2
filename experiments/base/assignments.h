// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "experiments/base/parameter.h"

namespace limen {

/// Values by path, from command-line arguments: "minkowski_exponent=3", "adaptation=fixed" or
/// "adaptation.kind=fixed", "adaptation.luminance_cd_m2=50", and a number for a choice that has a shorthand.
/// Types are those of the declarations; ParameterValues checks ranges and which parameters may be combined.
/// Throws Error at `where` (the option): no '=', an unknown path with the nearest known one, a path given
/// twice.
std::map<std::string, ParameterValue> readAssignments(const std::vector<std::string>& texts,
                                                      const std::vector<Parameter>& declared,
                                                      const std::string& where);

}  // namespace limen
