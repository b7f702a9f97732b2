// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "experiments/base/parameter.h"

/// Declarations without a settings struct, and values by their paths: for tests of what reads and writes
/// declarations. The program itself declares settings by tables.
namespace limen {

inline Parameter declared(ParameterType type, std::string name, ParameterValue defaultValue,
                          std::string description, std::string unit = {}) {
  Parameter out;
  out.name = std::move(name);
  out.type = type;
  out.defaultValue = std::move(defaultValue);
  out.description = std::move(description);
  out.unit = std::move(unit);
  return out;
}

inline Parameter booleanParameter(std::string name, bool defaultValue, std::string description) {
  return declared(ParameterType::Boolean, std::move(name), defaultValue, std::move(description));
}
inline Parameter integerParameter(std::string name, int64_t defaultValue, int64_t least, int64_t most,
                                  std::string unit, std::string description) {
  Parameter out = declared(ParameterType::Integer, std::move(name), defaultValue, std::move(description),
                           std::move(unit));
  out.minimum = static_cast<double>(least);
  out.maximum = static_cast<double>(most);
  return out;
}
inline Parameter realParameter(std::string name, double defaultValue, double least, double most,
                               std::string unit, std::string description) {
  Parameter out =
      declared(ParameterType::Real, std::move(name), defaultValue, std::move(description), std::move(unit));
  out.minimum = least;
  out.maximum = most;
  return out;
}
inline Parameter choiceParameter(std::string name, std::string defaultValue, std::vector<std::string> choices,
                                 std::string description) {
  Parameter out =
      declared(ParameterType::Choice, std::move(name), std::move(defaultValue), std::move(description));
  out.choices = std::move(choices);
  return out;
}
inline Parameter textParameter(std::string name, std::string defaultValue, std::string description) {
  return declared(ParameterType::Text, std::move(name), std::move(defaultValue), std::move(description));
}
inline Parameter optionalFileParameter(std::string name, std::string description) {
  return declared(ParameterType::File, std::move(name), std::string(), std::move(description));
}
inline Parameter fileParameter(std::string name, std::string description) {
  Parameter out = optionalFileParameter(std::move(name), std::move(description));
  out.required = true;
  return out;
}

inline int64_t integerOf(const ParameterValues& values, const std::string& path) {
  return std::get<int64_t>(values.all().at(path));
}
inline double realOf(const ParameterValues& values, const std::string& path) {
  return std::get<double>(values.all().at(path));
}
inline bool booleanOf(const ParameterValues& values, const std::string& path) {
  return std::get<bool>(values.all().at(path));
}
inline const std::string& textOf(const ParameterValues& values, const std::string& path) {
  return std::get<std::string>(values.all().at(path));
}

}  // namespace limen
