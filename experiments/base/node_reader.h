// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/base/settings_table.h"
#include "experiments/base/value_reader.h"

namespace limen {

/// Reads maps, lists and scalars of a descriptor or a protocol; anything invalid becomes a problem, and
/// reading continues, so that a user sees all problems at once.
class NodeReader {
 public:
  NodeReader(Problems& problems, FileFinder& files)
      : problems_(problems), files_(files), values_(problems, files) {}

  Problems& problems() { return problems_; }
  FileFinder& files() { return files_; }
  ValueReader& values() { return values_; }

  /// `what` as a message begins with it: "'timing'", "a scene".
  bool isMap(const YamlNode& node, const std::string& what, const std::string& example);
  bool isFilledList(const YamlNode& node, const std::string& what, const std::string& example);
  /// `what` has the keys: "timing", "an expectation".
  void checkKeys(const YamlNode& map, const std::string& what, const std::vector<std::string>& known);

  /// The value of a key of a map, if present and valid.
  template <settings::Number T>
  void take(const YamlNode& map, const std::string& key, Range range, const std::string& unit, T& out) {
    if (const YamlNode* node = map.find(key))
      if (const auto value = number(*node, key, range, unit, std::is_integral_v<T>))
        settings::fromValue(*value, out);
  }
  void take(const YamlNode& map, const std::string& key, bool& out);
  template <NamedEnum E>
  void take(const YamlNode& map, const std::string& key, E& out) {
    if (const YamlNode* node = map.find(key))
      if (const auto value = choice(*node, key, namesOf<E>())) out = fromText<E>(*value);
  }
  /// A scalar as a number, integer or real, or as one of several names. `what`: how messages call it.
  std::optional<ParameterValue> number(const YamlNode& node, const std::string& what, Range range,
                                       const std::string& unit, bool whole);
  std::optional<std::string> choice(const YamlNode& node, const std::string& what,
                                    const std::vector<std::string>& names);
  /// Text; a problem if it is required and missing.
  void takeText(const YamlNode& map, const std::string& key, bool required, std::string& out);
  /// A list of distinct texts.
  std::vector<std::string> texts(const YamlNode& node, const std::string& what, const std::string& example);

  /// Settings that a map gives, the rest at their defaults; after a problem, defaults. `what` has the
  /// parameters: "timing".
  template <Settings S>
  S settings(const YamlNode& map, const std::string& what) {
    const auto values = complete(map, what, S::table().parameters());
    return values ? S::table().read(*values) : S{};
  }

 private:
  std::optional<ParameterValues> complete(const YamlNode& map, const std::string& what,
                                          const std::vector<Parameter>& declared);

  Problems& problems_;
  FileFinder& files_;
  ValueReader values_;
};

}  // namespace limen
