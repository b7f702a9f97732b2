// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/base/value_reader.h"
#include "study/protocol/protocol.h"

namespace limen::study {

/// Reads maps of a protocol; what does not fit becomes a problem.
class NodeReader {
 public:
  NodeReader(Problems& problems, FileFinder& files)
      : problems_(problems), files_(files), values_(problems, files) {}

  Problems& problems() { return problems_; }
  FileFinder& files() { return files_; }
  ValueReader& values() { return values_; }

  bool isMap(const YamlNode& node, const std::string& what, const std::string& example);
  bool isFilledList(const YamlNode& node, const std::string& what, const std::string& example);
  void checkKeys(const YamlNode& map, const std::string& what, const std::vector<std::string>& known);

  /// The value of key `parameter.name` of a map, if it is there and fits.
  void take(const YamlNode& map, const Parameter& parameter, double& out);
  void take(const YamlNode& map, const Parameter& parameter, int& out);
  void take(const YamlNode& map, const Parameter& parameter, bool& out);
  void takeChoice(const YamlNode& map, const Parameter& parameter, std::string& out);
  /// Text; a problem if it is required and missing.
  void takeText(const YamlNode& map, const std::string& key, bool required, std::string& out);
  /// Different texts.
  std::vector<std::string> texts(const YamlNode& node, const std::string& what, const std::string& example);

 private:
  std::optional<ParameterValue> valueOf(const YamlNode& map, const Parameter& parameter);

  Problems& problems_;
  FileFinder& files_;
  ValueReader values_;
};

}  // namespace limen::study
