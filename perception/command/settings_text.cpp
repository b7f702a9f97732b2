// SPDX-License-Identifier: BSD-3-Clause
#include "perception/command/settings_text.h"

#include <fmt/format.h>

#include <charconv>
#include <map>

#include "experiments/base/error.h"
#include "experiments/base/text.h"

namespace limen::perception {
namespace {

std::string fullName(const SettingsGroup& group, const Parameter& parameter) {
  return group.name.empty() ? parameter.name : group.name + "." + parameter.name;
}

template <class Number>
bool readNumber(const std::string& text, Number& value) {
  const char* const end = text.data() + text.size();
  const auto [stop, code] = std::from_chars(text.data(), end, value);
  return code == std::errc{} && stop == end;
}

/// The text as a value of the parameter's type; as text where it is none, so that validate() refuses it.
ParameterValue typed(const Parameter& parameter, const std::string& text) {
  int64_t whole = 0;
  double real = 0.0;
  switch (parameter.type) {
    case ParameterType::Boolean:
      if (text == "true" || text == "false") return text == "true";
      break;
    case ParameterType::Integer:
      if (readNumber(text, whole)) return whole;
      break;
    case ParameterType::Real:
      if (readNumber(text, real)) return real;
      break;
    default:
      break;
  }
  return text;
}

}  // namespace

std::vector<ParameterValues> parseSettings(const std::vector<std::string>& texts,
                                           const std::vector<SettingsGroup>& groups,
                                           const std::string& where) {
  std::vector<std::map<std::string, ParameterValue>> given(groups.size());
  std::vector<std::string> known;
  for (const SettingsGroup& group : groups)
    for (const Parameter& parameter : group.parameters) known.push_back(fullName(group, parameter));
  for (const std::string& text : texts) {
    const size_t split = text.find('=');
    if (split == std::string::npos)
      throw Error("'" + text + "' sets nothing", where, "write name=value; see --list");
    const std::string name = text.substr(0, split);
    bool found = false;
    for (size_t g = 0; g < groups.size() && !found; ++g)
      for (const Parameter& parameter : groups[g].parameters) {
        if (fullName(groups[g], parameter) != name) continue;
        found = true;
        const ParameterValue value = validate(parameter, typed(parameter, text.substr(split + 1)), where);
        if (!given[g].emplace(parameter.name, value).second)
          throw Error("'" + name + "' is set twice", where, "give it once");
      }
    if (!found) throw Error("no setting '" + name + "'", where, suggest(name, known));
  }
  std::vector<ParameterValues> values;
  for (size_t g = 0; g < groups.size(); ++g) values.emplace_back(groups[g].parameters, given[g], where);
  return values;
}

std::string listSettings(const std::vector<SettingsGroup>& groups) {
  std::string out;
  for (const SettingsGroup& group : groups)
    for (const Parameter& parameter : group.parameters) {
      out += fmt::format("  {}={}\n      {}\n      {}\n", fullName(group, parameter),
                         toText(parameter.defaultValue), parameter.description, describeRange(parameter));
      if (!parameter.source.empty()) out += fmt::format("      source: {}\n", parameter.source);
    }
  return out.empty() ? "  none\n" : out;
}

nlohmann::json settingsAsJson(const std::vector<SettingsGroup>& groups) {
  nlohmann::json out = nlohmann::json::array();
  for (const SettingsGroup& group : groups)
    for (const Parameter& parameter : group.parameters) {
      nlohmann::json entry = toJson(parameter);
      entry["name"] = fullName(group, parameter);
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
  for (size_t g = 0; g < groups.size(); ++g)
    for (const Parameter& parameter : groups[g].parameters) {
      const ParameterValue& value = values[g].all().at(parameter.name);
      if (value != parameter.defaultValue)
        changed.push_back(fullName(groups[g], parameter) + " " + toText(value));
    }
  return join(changed);
}

}  // namespace limen::perception
