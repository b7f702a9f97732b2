// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/parameter.h"

#include <algorithm>
#include <cassert>
#include <cmath>

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
  }
  return {};
}

Parameter booleanParameter(std::string name, bool defaultValue, std::string description, std::string source) {
  return {std::move(name),        ParameterType::Boolean, defaultValue, {}, {}, {}, {},
          std::move(description), std::move(source),      false};
}

Parameter integerParameter(std::string name, int64_t defaultValue, int64_t minimum, int64_t maximum,
                           std::string unit, std::string description, std::string source) {
  return {std::move(name),
          ParameterType::Integer,
          defaultValue,
          static_cast<double>(minimum),
          static_cast<double>(maximum),
          {},
          std::move(unit),
          std::move(description),
          std::move(source),
          false};
}

Parameter realParameter(std::string name, double defaultValue, double minimum, double maximum,
                        std::string unit, std::string description, std::string source) {
  return {std::move(name), ParameterType::Real,    defaultValue,      minimum, maximum, {},
          std::move(unit), std::move(description), std::move(source), false};
}

Parameter choiceParameter(std::string name, std::string defaultValue, std::vector<std::string> choices,
                          std::string description, std::string source) {
  assert(std::find(choices.begin(), choices.end(), defaultValue) != choices.end());
  return {std::move(name),
          ParameterType::Choice,
          std::move(defaultValue),
          {},
          {},
          std::move(choices),
          {},
          std::move(description),
          std::move(source),
          false};
}

Parameter textParameter(std::string name, std::string defaultValue, std::string description,
                        std::string source) {
  return {std::move(name),
          ParameterType::Text,
          std::move(defaultValue),
          {},
          {},
          {},
          {},
          std::move(description),
          std::move(source),
          false};
}

Parameter fileParameter(std::string name, std::string description) {
  return {
      std::move(name), ParameterType::File, std::string{}, {}, {}, {}, {}, std::move(description), {}, true};
}

Parameter optionalFileParameter(std::string name, std::string description) {
  Parameter parameter = fileParameter(std::move(name), std::move(description));
  parameter.required = false;
  return parameter;
}

std::string describeRange(const Parameter& parameter) {
  if (parameter.type == ParameterType::Choice) return "one of " + join(parameter.choices);
  std::string out = describeType(parameter.type);
  if (parameter.minimum && parameter.maximum)
    out += " from " + shortestNumber(*parameter.minimum) + " to " + shortestNumber(*parameter.maximum);
  if (!parameter.unit.empty()) out += " (" + parameter.unit + ")";
  return out;
}

ParameterValue validate(const Parameter& parameter, const ParameterValue& value, const std::string& where) {
  const auto refuse = [&](const std::string& mend = {}) -> Error {
    const std::string allowed = "allowed: " + describeRange(parameter);
    return Error("'" + parameter.name + "' is " + toText(value), where,
                 mend.empty() ? allowed : mend + "; " + allowed);
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
  return result;
}

ParameterValues::ParameterValues(const std::vector<Parameter>& declared,
                                 const std::map<std::string, ParameterValue>& given,
                                 const std::string& where) {
  std::vector<std::string> names;
  for (const Parameter& parameter : declared) names.push_back(parameter.name);
  for (const auto& [name, value] : given) {
    const auto match =
        std::find_if(declared.begin(), declared.end(),
                     [&name = name](const Parameter& parameter) { return parameter.name == name; });
    if (match == declared.end()) throw Error("unknown parameter '" + name + "'", where, suggest(name, names));
    values_[name] = validate(*match, value, where);
  }
  for (const Parameter& parameter : declared) {
    if (values_.count(parameter.name)) continue;
    if (parameter.required)
      throw Error("'" + parameter.name + "' is missing", where, "give it: " + describeRange(parameter));
    values_[parameter.name] = parameter.defaultValue;
  }
}

const ParameterValue& ParameterValues::at(const std::string& name) const {
  const auto entry = values_.find(name);
  assert(entry != values_.end() && "parameter was never declared");
  return entry->second;
}

bool ParameterValues::boolean(const std::string& name) const { return std::get<bool>(at(name)); }
int64_t ParameterValues::integer(const std::string& name) const { return std::get<int64_t>(at(name)); }
double ParameterValues::real(const std::string& name) const { return std::get<double>(at(name)); }
const std::string& ParameterValues::text(const std::string& name) const {
  return std::get<std::string>(at(name));
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
  if (!parameter.required) out["default"] = toJson(parameter.defaultValue);
  if (!parameter.unit.empty()) out["unit"] = parameter.unit;
  if (!parameter.source.empty()) out["source"] = parameter.source;
  if (!parameter.choices.empty()) out["choices"] = parameter.choices;
  return out;
}

}  // namespace limen
