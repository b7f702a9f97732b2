// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

namespace limen::experiments {

/// A method that a feature names but that is deliberately left out.
struct NotBuilt {
  std::string method;   ///< name and authors
  std::string section;  ///< of the feature's source
  std::string reason;   ///< why it is left out
};

/// Something that a thesis contributes, compares with or builds on.
struct Feature {
  std::string id;  ///< family and number: "SS-12"
  std::string name;
  std::string source;                   ///< "Schwarz 2009, chapter 4"
  std::string section;                  ///< "4.2"
  std::string kind;                     ///< contribution, comparator or background
  std::vector<NotBuilt> notBuilt = {};  ///< methods that are only surveyed; mostly empty

  std::string family() const { return id.substr(0, id.find('-')); }
};

/// Reads experiments/features.yaml. Throws Error naming file and line.
std::vector<Feature> readFeatures(const std::string& path);

/// Ids of `root`/experiments/features.yaml; empty if the file is missing.
std::set<std::string> knownFeatures(const std::string& root);

/// Which descriptors exercise which feature.
struct Coverage {
  std::vector<Feature> features;
  std::map<std::string, std::vector<std::string>>
      descriptors;  ///< feature id -> descriptor paths, from `root`
  size_t descriptorCount = 0;

  bool covers(const Feature& feature) const { return descriptors.count(feature.id) != 0; }
  /// No descriptor exercises it, and it states why none can.
  bool isOnlySurveyed(const Feature& feature) const { return !covers(feature) && !feature.notBuilt.empty(); }
};

/// Reads the features and the `features` of all descriptors below `root`/experiments/descriptors. Throws
/// Error on a descriptor that cannot be read or names an unknown feature.
Coverage readCoverage(const std::string& root);

std::string describe(const Coverage& coverage);
/// One line per feature and a summary, as --json prints them.
std::vector<nlohmann::json> toJsonLines(const Coverage& coverage);

}  // namespace limen::experiments
