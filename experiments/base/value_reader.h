// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/base/parameter.h"
#include "experiments/base/problems.h"
#include "experiments/base/yaml_tree.h"

namespace limen {

/// Files that a descriptor names: found relative to its folder, then to the working directory, each hashed
/// once.
class FileFinder {
 public:
  explicit FileFinder(const std::string& descriptorPath);

  /// Absolute path, or nothing after adding a problem.
  std::optional<std::string> find(const std::string& named, Mark mark, Problems& problems);

  const std::map<std::string, std::string>& hashes() const { return hashes_; }
  const std::map<std::string, std::string>& asNamed() const { return asNamed_; }

 private:
  std::vector<std::string> folders_;
  std::map<std::string, std::string> hashes_, asNamed_;
};

/// Reads scalars as declared parameters. Anything invalid becomes a problem and gives nothing.
class ValueReader {
 public:
  ValueReader(Problems& problems, FileFinder& files) : problems_(problems), files_(files) {}

  std::optional<ParameterValue> value(const YamlNode& node, const Parameter& parameter);
  /// One value, or a list of distinct values.
  std::vector<ParameterValue> values(const YamlNode& node, const Parameter& parameter);
  /// Whether `node` would be accepted, without adding a problem. Not for File parameters.
  static bool fits(const YamlNode& node, const Parameter& parameter);

  std::optional<std::string> text(const YamlNode& node, const std::string& key);
  std::optional<double> number(const YamlNode& node, const std::string& key);

 private:
  Problems& problems_;
  FileFinder& files_;
};

}  // namespace limen
