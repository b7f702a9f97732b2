// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/measurement_name.h"

#include <algorithm>

namespace limen::experiments {
namespace {

/// What distinguishes this one from others of the same metric: its non-default values; none if there are no
/// others.
std::vector<std::string> distinctions(const Configuration& metric, const std::vector<Configuration>& all,
                                      const std::vector<Parameter>& declared) {
  const auto sameName = [&](const Configuration& other) { return other.name == metric.name; };
  std::vector<std::string> out;
  if (std::count_if(all.begin(), all.end(), sameName) < 2) return out;
  for (const DeclaredAt& at : chosen(declared, metric.values)) {
    const ParameterValue& value = *metric.values.find(at.path);
    if (value != at.parameter->defaultValue) out.push_back(toText(value));
  }
  return out;
}

}  // namespace

std::string measurementName(const Configuration& metric, const std::vector<Configuration>& all,
                            const std::vector<Parameter>& declared) {
  std::string name = metric.name;
  for (const std::string& value : distinctions(metric, all, declared)) name += "_" + value;
  return name;
}

std::vector<std::string> measurementNames(const Configuration& metric, const std::vector<Configuration>& all,
                                          const std::vector<Parameter>& declared,
                                          const std::vector<Quantity>& figures) {
  const std::string own = measurementName(metric, all, declared);
  if (figures.empty()) return {own};
  std::vector<std::string> out;
  for (const Quantity& figure : figures) out.push_back(own + "_" + figure.name);
  return out;
}

std::string measurementTitle(const std::string& title, const Configuration& metric,
                             const std::vector<Configuration>& all, const std::vector<Parameter>& declared) {
  std::string out = title;
  for (const std::string& value : distinctions(metric, all, declared)) out += ", " + value;
  return out;
}

}  // namespace limen::experiments
