// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/value_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "experiments/base/text.h"

namespace limen {
namespace {

using Values = std::map<std::string, ParameterValue>;

/// Calls `visit(path, value)` for each value of an existing parameter that is not its default, outer ones
/// first.
template <class Visit>
void visitExisting(const std::vector<Parameter>& declared, const Values& values, const std::string& prefix,
                   const Visit& visit) {
  for (const Parameter& parameter : declared) {
    const std::string path = joinPath(prefix, parameter.name);
    if (parameter.type == ParameterType::Group) {
      visitExisting(parameter.alternatives.at(0).parameters, values, path, visit);
      continue;
    }
    const auto found = values.find(path);
    const ParameterValue& value = found == values.end() ? parameter.defaultValue : found->second;
    if (found != values.end() && (parameter.required || value != parameter.defaultValue)) visit(path, value);
    if (parameter.type != ParameterType::Choice) continue;
    if (const Alternative* chosen = findAlternative(parameter, std::get<std::string>(value)))
      visitExisting(chosen->parameters, values, path, visit);
  }
}

/// Whether YAML readers take it as text without quotes.
bool isPlainName(const std::string& text) {
  const auto isWord = [](unsigned char c) { return std::isalnum(c) || c == '_'; };
  if (text.empty() || !std::isalpha(static_cast<unsigned char>(text[0])) ||
      !std::all_of(text.begin(), text.end(), isWord))
    return false;
  constexpr std::array<const char*, 9> kReserved = {"true", "false", "yes", "no", "on",
                                                    "off",  "null",  "y",   "n"};
  std::string lower = text;
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return std::find(kReserved.begin(), kReserved.end(), lower) == kReserved.end();
}

/// Members of a map, from values that all differ from their defaults.
std::string members(const std::vector<Parameter>& declared, const Values& differing,
                    const std::string& prefix) {
  std::vector<std::string> out;
  for (const Parameter& parameter : declared) {
    const std::string path = joinPath(prefix, parameter.name);
    if (parameter.type == ParameterType::Group) {
      const std::string inner = members(parameter.alternatives.at(0).parameters, differing, path);
      if (!inner.empty()) out.push_back(parameter.name + ": {" + inner + "}");
      continue;
    }
    const auto found = differing.find(path);
    const ParameterValue& value = found == differing.end() ? parameter.defaultValue : found->second;
    const Alternative* chosen = parameter.type == ParameterType::Choice
                                    ? findAlternative(parameter, std::get<std::string>(value))
                                    : nullptr;
    const std::string inner = chosen ? members(chosen->parameters, differing, path) : "";
    if (inner.empty()) {
      if (found != differing.end()) out.push_back(parameter.name + ": " + toYaml(value));
      continue;
    }
    const std::string kind = found == differing.end() ? "" : "kind: " + toYaml(value) + ", ";
    out.push_back(parameter.name + ": {" + kind + inner + "}");
  }
  return join(out);
}

}  // namespace

Values withoutDefaults(const std::vector<Parameter>& declared, const Values& values) {
  Values out;
  const std::optional<std::vector<Parameter>> preset = withPresets(declared, values);
  visitExisting(preset ? *preset : declared, values, {},
                [&](const std::string& path, const ParameterValue& value) { out.emplace(path, value); });
  return out;
}

std::string toYaml(const std::vector<Parameter>& declared, const Values& values) {
  const std::optional<std::vector<Parameter>> preset = withPresets(declared, values);
  return members(preset ? *preset : declared, withoutDefaults(declared, values), {});
}

std::string toYaml(const ParameterValue& value) {
  const auto* text = std::get_if<std::string>(&value);
  if (!text) return toText(value);
  if (isPlainName(*text)) return *text;
  std::string out = "\"";
  for (const char c : *text) {
    if (c == '"' || c == '\\')
      (out += '\\') += c;
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F)
      out += fmt::format("\\x{:02x}", static_cast<unsigned>(c));
    else
      out += c;
  }
  return out + "\"";
}

}  // namespace limen
