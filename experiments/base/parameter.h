// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace limen {

/// Group: parameters under one name, without a value of its own.
enum class ParameterType { Boolean, Integer, Real, Choice, Text, File, Group };

/// Name of a type as messages and help print it: "true or false", "whole number", ...
std::string describeType(ParameterType type);

/// Boolean -> bool, Integer -> int64_t, Real -> double, Choice, Text and File -> string.
using ParameterValue = std::variant<bool, int64_t, double, std::string>;

struct Alternative;

/// The one declaration of a parameter of a scene, technique or metric. Validation, sweep axes, help, viewer
/// controls, result columns and axis labels all come from it. It is made by a settings table (see
/// settings_table.h), not by hand.
///
/// Parameters form a tree: each alternative of a choice may have parameters of its own, which exist only
/// where it is chosen. A parameter is known by its path, names joined by dots: "budget.rim".
struct Parameter {
  std::string name;  ///< snake_case, as in descriptors
  ParameterType type = ParameterType::Real;
  ParameterValue defaultValue;
  std::optional<double> minimum, maximum;  ///< inclusive; Integer and Real only
  std::vector<int64_t> allowed;            ///< Integer only: only these numbers; empty: all in range
  std::vector<std::string> choices;        ///< Choice only
  std::string unit;                        ///< "" for pure numbers
  std::string description;                 ///< one line
  std::string source;                      ///< thesis section or paper; "" for the bench's own
  bool required = false;                   ///< no default: the descriptor must give it
  /// At its default it is not part of run keys, so results from before it was declared keep their keys.
  bool keyedIfGiven = false;
  /// Choice: none, or one for each of `choices`. Group: one without a name.
  std::vector<Alternative> alternatives;
  /// Choice or Group: the parameter of the default alternative, or of the group, that a number in its place
  /// stands for ("budget: 256" for "budget: {kind: uniform, limit: 256}"); "": a number is refused.
  std::string shorthand = {};
  /// Former names of this parameter; an error replies to them with the new form.
  std::vector<std::string> formerNames = {};
  /// As an axis label, without the unit; "": the words of the name.
  std::string title = {};
  /// Choice only: the defaults of its neighbours and of what is below them, by path from there, where
  /// `choice` is chosen. Null: they have one default each.
  std::map<std::string, ParameterValue> (*preset)(const std::string& choice) = nullptr;
};

/// One of several values of a Choice, with the parameters that only it has.
struct Alternative {
  std::string name;
  std::string description;  ///< what it is, as a noun phrase; "": the name suffices
  std::vector<Parameter> parameters;
};

/// The alternative of that name; null if the parameter has none.
const Alternative* findAlternative(const Parameter& parameter, const std::string& name);
/// "budget" and "rim" make "budget.rim"; an empty prefix changes nothing.
std::string joinPath(const std::string& prefix, const std::string& name);

/// A declaration with its place in the tree.
struct DeclaredAt {
  std::string path;  ///< "budget.rim"
  const Parameter* parameter = nullptr;
  /// Where it exists: values of the choices above it ("budget" -> "radial").
  std::map<std::string, std::string> when;
};
/// All declarations except groups, depth first in order of declaration. One path may come from several
/// alternatives.
std::vector<DeclaredAt> flatten(const std::vector<Parameter>& declared);

/// `declared` with the defaults of the presets chosen in `given`, by path; nothing if they are the same.
std::optional<std::vector<Parameter>> withPresets(const std::vector<Parameter>& declared,
                                                  const std::map<std::string, ParameterValue>& given);

/// "whole number from 1 to 4096", "one of a, b, c", "number from 0 to 1 (m)".
std::string describeRange(const Parameter& parameter);

/// Checks type and range. Returns the value converted to the parameter's type (an integer is accepted for a
/// Real). Throws Error whose message says what was found and what is allowed; `where` goes into the error.
ParameterValue validate(const Parameter& parameter, const ParameterValue& value, const std::string& where);

/// A complete set of values for one declaration tree, by path: every parameter that exists has a value, and a
/// choice's value is the name of the chosen alternative.
class ParameterValues {
 public:
  ParameterValues() = default;
  /// Takes the defaults of `declared`, or of a preset chosen in `given`, and overrides them with `given`, by
  /// path. Throws Error on an unknown name (with the nearest known one), one that belongs to an alternative
  /// that is not chosen, a bad value or a missing required parameter.
  ParameterValues(const std::vector<Parameter>& declared, const std::map<std::string, ParameterValue>& given,
                  const std::string& where = {});

  bool has(const std::string& path) const { return values_.count(path) != 0; }
  /// Null if no parameter with that path exists under the choices made.
  const ParameterValue* find(const std::string& path) const;
  const std::map<std::string, ParameterValue>& all() const { return values_; }
  /// Values below `prefix`, by the rest of their paths.
  ParameterValues below(const std::string& prefix) const;

  /// Object with sorted paths as keys: the canonical form that run keys are hashed from.
  nlohmann::json toJson() const;

  friend bool operator==(const ParameterValues&, const ParameterValues&) = default;

 private:
  std::map<std::string, ParameterValue> values_;
};

/// The declarations of `values`, those that exist under its choices, in order of declaration.
std::vector<DeclaredAt> chosen(const std::vector<Parameter>& declared, const ParameterValues& values);

/// Text form of a value, shortest that reads back to the same number ("0.05", "true", "jittered_16").
std::string toText(const ParameterValue& value);
nlohmann::json toJson(const ParameterValue& value);
nlohmann::json toJson(const Parameter& parameter);

}  // namespace limen
