// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "experiments/base/parameter.h"

namespace limen {

/// Those of `values`, by path, that differ from their defaults, and required ones. Values of parameters that
/// do not exist under the alternatives chosen are left out.
std::map<std::string, ParameterValue> withoutDefaults(const std::vector<Parameter>& declared,
                                                      const std::map<std::string, ParameterValue>& values);

/// withoutDefaults() in the nested form that descriptors use, as members of a YAML flow map:
/// "budget: {kind: radial, rim: 25}, samples: 64"; "" where there are none. The kind of a default alternative
/// is left out. Values that are not in `values` are at their default.
std::string toYaml(const std::vector<Parameter>& declared,
                   const std::map<std::string, ParameterValue>& values);

/// One value as YAML that reads back as the same: text in double quotes unless it is a plain name.
std::string toYaml(const ParameterValue& value);

}  // namespace limen
