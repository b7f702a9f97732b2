// SPDX-License-Identifier: BSD-3-Clause
#include "perception/command/settings_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "experiments/base/assignments.h"
#include "experiments/base/text.h"

namespace limen::perception {
namespace {

/// All groups as one declaration: a named one is a group of parameters.
std::vector<Parameter> declaredOf(const std::vector<SettingsGroup>& groups) {
  std::vector<Parameter> out;
  for (const SettingsGroup& group : groups) {
    if (group.name.empty()) {
      out.insert(out.end(), group.parameters.begin(), group.parameters.end());
      continue;
    }
    Parameter named;
    named.name = group.name;
    named.type = ParameterType::Group;
    named.alternatives = {{{}, {}, group.parameters}};
    out.push_back(std::move(named));
  }
  return out;
}

/// "adaptation: fixed": choices that a parameter exists under; "" if it always exists.
std::string existsWith(const DeclaredAt& at) {
  std::vector<std::string> parts;
  for (const auto& [path, kind] : at.when) parts.push_back(path + "=" + kind);
  return join(parts);
}

bool exists(const DeclaredAt& at, const ParameterValues& values) {
  return std::all_of(at.when.begin(), at.when.end(), [&](const auto& choice) {
    const ParameterValue* value = values.find(choice.first);
    return value && *value == ParameterValue(choice.second);
  });
}

}  // namespace

std::vector<ParameterValues> parseSettings(const std::vector<std::string>& texts,
                                           const std::vector<SettingsGroup>& groups,
                                           const std::string& where) {
  const std::map<std::string, ParameterValue> given = readAssignments(texts, declaredOf(groups), where);
  std::vector<ParameterValues> values;
  for (const SettingsGroup& group : groups) {
    std::map<std::string, ParameterValue> own;
    for (const auto& [name, value] : given) {
      const std::string& path = name;  // a lambda must not take a structured binding
      const auto named = std::find_if(groups.begin(), groups.end(), [&](const SettingsGroup& other) {
        return !other.name.empty() && path.starts_with(other.name + ".");
      });
      const std::string owner = named == groups.end() ? "" : named->name;
      if (owner == group.name) own[owner.empty() ? path : path.substr(owner.size() + 1)] = value;
    }
    values.emplace_back(group.parameters, own, where);
  }
  return values;
}

std::string listSettings(const std::vector<SettingsGroup>& groups) {
  const std::vector<Parameter> declared = declaredOf(groups);
  std::string out;
  for (const DeclaredAt& at : flatten(declared)) {
    const Parameter& parameter = *at.parameter;
    const std::string with = existsWith(at);
    out += fmt::format("  {}={}{}\n      {}\n      {}\n", at.path, toText(parameter.defaultValue),
                       with.empty() ? "" : "  (with " + with + ")", parameter.description,
                       describeRange(parameter));
    for (const Alternative& alternative : parameter.alternatives)
      if (!alternative.description.empty())
        out += fmt::format("        {}: {}\n", alternative.name, alternative.description);
    if (!parameter.source.empty()) out += fmt::format("      source: {}\n", parameter.source);
  }
  return out.empty() ? "  none\n" : out;
}

nlohmann::json settingsAsJson(const std::vector<SettingsGroup>& groups) {
  const std::vector<Parameter> declared = declaredOf(groups);
  nlohmann::json out = nlohmann::json::array();
  for (const DeclaredAt& at : flatten(declared)) {
    nlohmann::json entry = toJson(*at.parameter);
    entry.erase("alternatives");  // they have their own entries
    entry["name"] = at.path;
    if (!at.when.empty()) entry["when"] = at.when;
    out.push_back(entry);
  }
  return out;
}

nlohmann::json valuesAsJson(const std::vector<SettingsGroup>& groups,
                            const std::vector<ParameterValues>& values) {
  nlohmann::json out = nlohmann::json::object();
  for (size_t g = 0; g < groups.size(); ++g) {
    if (groups[g].name.empty()) {
      out.update(values[g].toJson());
    } else {
      out[groups[g].name] = values[g].toJson();
    }
  }
  return out;
}

std::string changedSettings(const std::vector<SettingsGroup>& groups,
                            const std::vector<ParameterValues>& values) {
  std::vector<std::string> changed;
  for (size_t g = 0; g < groups.size(); ++g) {
    const std::optional<std::vector<Parameter>> preset = withPresets(groups[g].parameters, values[g].all());
    for (const DeclaredAt& at : flatten(preset ? *preset : groups[g].parameters)) {
      if (!exists(at, values[g])) continue;
      const ParameterValue& value = values[g].all().at(at.path);
      if (value != at.parameter->defaultValue)
        changed.push_back(joinPath(groups[g].name, at.path) + " " + toText(value));
    }
  }
  return join(changed);
}

}  // namespace limen::perception
