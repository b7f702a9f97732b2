// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace limen {

enum class ParameterType { Boolean, Integer, Real, Choice, Text, File };

/// Name of a type as messages and help print it: "true or false", "whole number", ...
std::string describeType(ParameterType type);

/// Boolean -> bool, Integer -> int64_t, Real -> double, Choice, Text and File -> string.
using ParameterValue = std::variant<bool, int64_t, double, std::string>;

/// The one declaration of a parameter of a scene, technique or metric. Validation, sweep axes, help, viewer
/// controls, result columns and axis labels all come from it.
struct Parameter {
  std::string name;  ///< snake_case, as in descriptors
  ParameterType type = ParameterType::Real;
  ParameterValue defaultValue;
  std::optional<double> minimum, maximum;  ///< inclusive; Integer and Real only
  std::vector<std::string> choices;        ///< Choice only
  std::string unit;                        ///< "" for pure numbers
  std::string description;                 ///< one line
  std::string source;                      ///< thesis section or paper; "" for the bench's own
  bool required = false;                   ///< no default: the descriptor must give it
  /// At its default it is no part of run keys: results from before it was declared keep theirs.
  bool keyedIfGiven = false;
};

Parameter booleanParameter(std::string name, bool defaultValue, std::string description,
                           std::string source = {});
Parameter integerParameter(std::string name, int64_t defaultValue, int64_t minimum, int64_t maximum,
                           std::string unit, std::string description, std::string source = {});
Parameter realParameter(std::string name, double defaultValue, double minimum, double maximum,
                        std::string unit, std::string description, std::string source = {});
Parameter choiceParameter(std::string name, std::string defaultValue, std::vector<std::string> choices,
                          std::string description, std::string source = {});
/// A line of free text; whoever declares it says in which form.
Parameter textParameter(std::string name, std::string defaultValue, std::string description,
                        std::string source = {});
/// A file that must be given.
Parameter fileParameter(std::string name, std::string description);
/// A file that may be given; "" if it is not.
Parameter optionalFileParameter(std::string name, std::string description);

/// "whole number from 1 to 4096", "one of a, b, c", "number from 0 to 1 (m)".
std::string describeRange(const Parameter& parameter);

/// Checks type and range. Returns the value converted to the parameter's type (an integer is accepted for a
/// Real). Throws Error whose message says what was found and what is allowed; `where` goes into the error.
ParameterValue validate(const Parameter& parameter, const ParameterValue& value, const std::string& where);

/// A complete set of values for one declaration list: every declared name has a value.
class ParameterValues {
 public:
  ParameterValues() = default;
  /// Takes the defaults of `declared` and overrides them with `given`. Throws Error on an unknown name (with
  /// the nearest known one), a bad value or a missing required parameter.
  ParameterValues(const std::vector<Parameter>& declared, const std::map<std::string, ParameterValue>& given,
                  const std::string& where = {});

  bool boolean(const std::string& name) const;
  int64_t integer(const std::string& name) const;
  double real(const std::string& name) const;
  const std::string& text(const std::string& name) const;  ///< Choice, Text and File
  bool has(const std::string& name) const { return values_.count(name) != 0; }
  const std::map<std::string, ParameterValue>& all() const { return values_; }

  /// Object with sorted keys: the canonical form that run keys are hashed from.
  nlohmann::json toJson() const;

 private:
  const ParameterValue& at(const std::string& name) const;
  std::map<std::string, ParameterValue> values_;
};

/// Text form of a value, shortest that reads back to the same number ("0.05", "true", "jittered_16").
std::string toText(const ParameterValue& value);
nlohmann::json toJson(const ParameterValue& value);
nlohmann::json toJson(const Parameter& parameter);

}  // namespace limen
