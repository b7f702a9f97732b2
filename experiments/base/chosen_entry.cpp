// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/chosen_entry.h"

#include "experiments/base/error.h"

namespace limen::settings {
namespace {

std::string kindOf(const std::string& name) { return name.substr(name.rfind('/') + 1); }

}  // namespace

void EntryAccess::declare(const Parameter& stated, const void* defaults, std::vector<Parameter>& out) const {
  Parameter parameter = stated;
  parameter.defaultValue = kindOf(entry(defaults).name);
  for (const std::string& name : options_.names) {
    std::vector<Parameter> members = options_.parametersOf(name);
    parameter.choices.push_back(kindOf(name));
    parameter.alternatives.push_back({kindOf(name), name, std::move(members)});
  }
  out.push_back(std::move(parameter));
}

void EntryAccess::read(const Parameter& stated, void* settings, const ParameterValues& values,
                       const std::string& prefix) const {
  const std::string path = joinPath(prefix, stated.name);
  const auto& kind = std::get<std::string>(values.all().at(path));
  ChosenEntry& chosen = entry(settings);
  for (const std::string& name : options_.names)
    if (kindOf(name) == kind) chosen.name = name;
  chosen.values = values.below(path);
  try {
    if (options_.check) options_.check(chosen.name, chosen.values);
  } catch (const Error& error) {
    throw Error(error.message(), joinPath(stated.name, error.where()), error.hint());
  }
}

void EntryAccess::write(const Parameter& stated, const void* settings, const std::string& prefix,
                        std::map<std::string, ParameterValue>& out) const {
  const ChosenEntry& chosen = entry(settings);
  const std::string path = joinPath(prefix, stated.name);
  out[path] = kindOf(chosen.name);
  const ParameterValues complete(options_.parametersOf(chosen.name), chosen.values.all());
  for (const auto& [name, value] : complete.all()) out[joinPath(path, name)] = value;
}

}  // namespace limen::settings
