// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/measurement_name.h"

#include <algorithm>

namespace limen::experiments {

std::string measurementName(const Choice& metric, const std::vector<Choice>& all,
                            const std::vector<Parameter>& declared) {
  const auto sameName = [&](const Choice& other) { return other.name == metric.name; };
  std::string name = metric.name;
  if (std::count_if(all.begin(), all.end(), sameName) < 2) return name;
  for (const DeclaredAt& at : chosen(declared, metric.values)) {
    const ParameterValue& value = *metric.values.find(at.path);
    if (value != at.parameter->defaultValue) name += "_" + toText(value);
  }
  return name;
}

}  // namespace limen::experiments
