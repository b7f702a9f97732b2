// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/parameter.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/base/error.h"
#include "experiments/base/text.h"

namespace limen {

std::string describeType(ParameterType type) {
  switch (type) {
    case ParameterType::Boolean:
      return "true or false";
    case ParameterType::Integer:
      return "whole number";
    case ParameterType::Real:
      return "number";
    case ParameterType::Choice:
      return "choice";
    case ParameterType::Text:
      return "text";
    case ParameterType::File:
      return "path of a file";
    case ParameterType::Group:
      return "group of parameters";
  }
  return {};
}

std::string describeRange(const Parameter& parameter) {
  if (parameter.type == ParameterType::Choice) return "one of " + join(parameter.choices);
  std::string out = describeType(parameter.type);
  if (!parameter.allowed.empty()) {
    std::vector<std::string> numbers;
    for (const int64_t number : parameter.allowed) numbers.push_back(std::to_string(number));
    out = "one of " + join(numbers);
  } else if (parameter.minimum && parameter.maximum)
    out += " from " + shortestNumber(*parameter.minimum) + " to " + shortestNumber(*parameter.maximum);
  if (!parameter.unit.empty()) out += " (" + parameter.unit + ")";
  return out;
}

ParameterValue validate(const Parameter& parameter, const ParameterValue& value, const std::string& where) {
  const auto refuse = [&](const std::string& hint = {}) -> Error {
    const std::string allowed = "allowed: " + describeRange(parameter);
    return Error("'" + parameter.name + "' is " + toText(value), where,
                 hint.empty() ? allowed : hint + "; " + allowed);
  };
  ParameterValue result = value;
  switch (parameter.type) {
    case ParameterType::Boolean:
      if (!std::holds_alternative<bool>(value)) throw refuse();
      break;
    case ParameterType::Integer:
      if (!std::holds_alternative<int64_t>(value)) throw refuse();
      break;
    case ParameterType::Real:
      if (const auto* whole = std::get_if<int64_t>(&value)) result = static_cast<double>(*whole);
      if (!std::holds_alternative<double>(result) || !std::isfinite(std::get<double>(result))) throw refuse();
      break;
    case ParameterType::Choice:
    case ParameterType::Text:
    case ParameterType::File:
      if (!std::holds_alternative<std::string>(value)) throw refuse();
      break;
    case ParameterType::Group:
      throw refuse();
  }
  if (parameter.type == ParameterType::Choice) {
    const std::string& text = std::get<std::string>(value);
    if (std::find(parameter.choices.begin(), parameter.choices.end(), text) == parameter.choices.end()) {
      const std::string nearest = nearestName(text, parameter.choices);
      throw refuse(nearest.empty() ? "" : "did you mean '" + nearest + "'?");
    }
  }
  const double number = std::holds_alternative<int64_t>(result)
                            ? static_cast<double>(std::get<int64_t>(result))
                        : std::holds_alternative<double>(result) ? std::get<double>(result)
                                                                 : 0.0;
  if ((parameter.minimum && number < *parameter.minimum) ||
      (parameter.maximum && number > *parameter.maximum))
    throw refuse();
  if (!parameter.allowed.empty() && std::find(parameter.allowed.begin(), parameter.allowed.end(),
                                              std::get<int64_t>(result)) == parameter.allowed.end())
    throw refuse();
  return result;
}

const Alternative* findAlternative(const Parameter& parameter, const std::string& name) {
  const auto match = std::find_if(parameter.alternatives.begin(), parameter.alternatives.end(),
                                  [&](const Alternative& alternative) { return alternative.name == name; });
  return match == parameter.alternatives.end() ? nullptr : &*match;
}

std::string joinPath(const std::string& prefix, const std::string& name) {
  return prefix.empty() ? name : prefix + "." + name;
}

namespace {

void flattenInto(const std::vector<Parameter>& declared, const std::string& prefix,
                 const std::map<std::string, std::string>& when, std::vector<DeclaredAt>& out) {
  for (const Parameter& parameter : declared) {
    const std::string path = joinPath(prefix, parameter.name);
    if (parameter.type != ParameterType::Group) out.push_back({path, &parameter, when});
    for (const Alternative& alternative : parameter.alternatives) {
      std::map<std::string, std::string> inner = when;
      if (parameter.type != ParameterType::Group) inner[path] = alternative.name;
      flattenInto(alternative.parameters, path, inner, out);
    }
  }
}

/// Sets defaults by path; those of parameters that `values` does not name stay, and those of alternatives
/// that it does not choose: one path may be a parameter of several.
void setDefaults(std::vector<Parameter>& declared, const std::string& prefix,
                 const std::map<std::string, ParameterValue>& values) {
  for (Parameter& parameter : declared) {
    const std::string path = joinPath(prefix, parameter.name);
    const auto value = values.find(path);
    if (value != values.end() && !parameter.preset) parameter.defaultValue = value->second;
    for (Alternative& alternative : parameter.alternatives)
      if (value == values.end() || value->second == ParameterValue(alternative.name))
        setDefaults(alternative.parameters, path, values);
  }
}

/// Whether a preset was applied.
bool applyPresets(std::vector<Parameter>& declared, const std::string& prefix,
                  const std::map<std::string, ParameterValue>& given) {
  bool applied = false;
  for (size_t i = 0; i < declared.size(); ++i) {
    const std::string path = joinPath(prefix, declared[i].name);
    const auto chosen = given.find(path);
    const auto* name = chosen == given.end() ? nullptr : std::get_if<std::string>(&chosen->second);
    if (declared[i].preset && name && ParameterValue(*name) != declared[i].defaultValue &&
        std::find(declared[i].choices.begin(), declared[i].choices.end(), *name) !=
            declared[i].choices.end()) {
      std::map<std::string, ParameterValue> values;
      for (const auto& [inner, value] : declared[i].preset(*name)) values[joinPath(prefix, inner)] = value;
      setDefaults(declared, prefix, values);
      applied = true;
    }
    for (Alternative& alternative : declared[i].alternatives)
      applied = applyPresets(alternative.parameters, path, given) || applied;
  }
  return applied;
}

bool hasPresets(const std::vector<Parameter>& declared) {
  return std::any_of(declared.begin(), declared.end(), [](const Parameter& parameter) {
    return parameter.preset || std::any_of(parameter.alternatives.begin(), parameter.alternatives.end(),
                                           [](const Alternative& one) { return hasPresets(one.parameters); });
  });
}

/// "budget: radial", from the choices that a parameter exists under.
std::string describeWhen(const std::map<std::string, std::string>& when) {
  std::vector<std::string> parts;
  for (const auto& [path, kind] : when) parts.push_back(path + ": " + kind);
  return join(parts, " and ");
}

/// Fills complete values, choice by choice.
class Completion {
 public:
  Completion(const std::map<std::string, ParameterValue>& given, const std::string& where,
             std::map<std::string, ParameterValue>& out)
      : given_(given), where_(where), out_(out) {}

  void fill(const std::vector<Parameter>& declared, const std::string& prefix) {
    for (const Parameter& parameter : declared) {
      const std::string path = joinPath(prefix, parameter.name);
      if (parameter.type == ParameterType::Group) {
        fill(parameter.alternatives.at(0).parameters, path);
        continue;
      }
      const auto given = given_.find(path);
      if (given == given_.end() && parameter.required)
        throw Error("'" + path + "' is missing", where_, "give it: " + describeRange(parameter));
      out_[path] = given == given_.end() ? parameter.defaultValue : valueOf(parameter, path, given->second);
      if (parameter.type != ParameterType::Choice) continue;
      if (const Alternative* chosen = findAlternative(parameter, std::get<std::string>(out_[path])))
        fill(chosen->parameters, path);
    }
  }

 private:
  ParameterValue valueOf(Parameter parameter, const std::string& path, const ParameterValue& value) const {
    parameter.name = path;  // as messages call it
    return validate(parameter, value, where_);
  }

  const std::map<std::string, ParameterValue>& given_;
  const std::string& where_;
  std::map<std::string, ParameterValue>& out_;
};

}  // namespace

std::vector<DeclaredAt> flatten(const std::vector<Parameter>& declared) {
  std::vector<DeclaredAt> out;
  flattenInto(declared, {}, {}, out);
  return out;
}

std::optional<std::vector<Parameter>> withPresets(const std::vector<Parameter>& declared,
                                                  const std::map<std::string, ParameterValue>& given) {
  if (given.empty() || !hasPresets(declared)) return {};
  std::vector<Parameter> out = declared;
  if (!applyPresets(out, {}, given)) return {};
  return out;
}

ParameterValues::ParameterValues(const std::vector<Parameter>& declared,
                                 const std::map<std::string, ParameterValue>& given,
                                 const std::string& where) {
  const std::optional<std::vector<Parameter>> preset = withPresets(declared, given);
  Completion(given, where, values_).fill(preset ? *preset : declared, {});
  for (const auto& [path, value] : given) {
    if (values_.count(path)) continue;
    std::vector<std::string> known, under;
    for (const DeclaredAt& at : flatten(declared)) {
      known.push_back(at.path);
      if (at.path == path) under.push_back(describeWhen(at.when));
    }
    if (under.empty()) throw Error("unknown parameter '" + path + "'", where, suggest(path, known));
    throw Error("'" + path + "' belongs to another choice", where,
                "it exists with " + join(under, ", or with "));
  }
}

std::vector<DeclaredAt> chosen(const std::vector<Parameter>& declared, const ParameterValues& values) {
  std::vector<DeclaredAt> out;
  for (DeclaredAt& at : flatten(declared)) {
    const bool exists = std::all_of(at.when.begin(), at.when.end(), [&](const auto& choice) {
      const ParameterValue* value = values.find(choice.first);
      return value && *value == ParameterValue(choice.second);
    });
    if (exists) out.push_back(std::move(at));
  }
  return out;
}

const ParameterValue* ParameterValues::find(const std::string& path) const {
  const auto entry = values_.find(path);
  return entry == values_.end() ? nullptr : &entry->second;
}

ParameterValues ParameterValues::below(const std::string& prefix) const {
  ParameterValues out;
  for (auto entry = values_.lower_bound(prefix + "."); entry != values_.end(); ++entry) {
    if (entry->first.compare(0, prefix.size() + 1, prefix + ".") != 0) break;
    out.values_.emplace(entry->first.substr(prefix.size() + 1), entry->second);
  }
  return out;
}

nlohmann::json ParameterValues::toJson() const {
  nlohmann::json out = nlohmann::json::object();
  for (const auto& [name, value] : values_) out[name] = limen::toJson(value);
  return out;
}

std::string toText(const ParameterValue& value) {
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (const auto* whole = std::get_if<int64_t>(&value)) return std::to_string(*whole);
  if (const auto* real = std::get_if<double>(&value)) return shortestNumber(*real);
  return std::get<std::string>(value);
}

nlohmann::json toJson(const ParameterValue& value) {
  return std::visit([](const auto& held) { return nlohmann::json(held); }, value);
}

nlohmann::json toJson(const Parameter& parameter) {
  nlohmann::json out = {{"name", parameter.name},
                        {"type", describeType(parameter.type)},
                        {"range", describeRange(parameter)},
                        {"description", parameter.description}};
  if (!parameter.required && parameter.type != ParameterType::Group)
    out["default"] = toJson(parameter.defaultValue);
  if (!parameter.unit.empty()) out["unit"] = parameter.unit;
  if (!parameter.source.empty()) out["source"] = parameter.source;
  if (!parameter.choices.empty()) out["choices"] = parameter.choices;
  if (!parameter.allowed.empty()) out["choices"] = parameter.allowed;
  if (parameter.type == ParameterType::Group) {
    out["parameters"] = nlohmann::json::array();
    for (const Parameter& member : parameter.alternatives.at(0).parameters)
      out["parameters"].push_back(toJson(member));
  } else if (!parameter.alternatives.empty()) {
    for (const Alternative& alternative : parameter.alternatives) {
      nlohmann::json members = nlohmann::json::array();
      for (const Parameter& member : alternative.parameters) members.push_back(toJson(member));
      out["alternatives"].push_back(
          {{"name", alternative.name}, {"description", alternative.description}, {"parameters", members}});
    }
  }
  return out;
}

}  // namespace limen
