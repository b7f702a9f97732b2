// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "perception/psychometrics/grid.h"

namespace limen::study {

/// Reads one object of settings and records which keys were read. Every function throws Error that names the
/// key.
class SettingsReader {
 public:
  /// `settings` has to be an object. `where` goes before the key in messages.
  SettingsReader(const nlohmann::json& settings, std::string where);

  /// "WHERE.KEY"
  std::string at(const std::string& key) const { return where_.empty() ? key : where_ + "." + key; }
  const std::string& where() const { return where_; }

  bool has(const std::string& key);
  /// The raw value; an error if it is missing. `allowed` says what is allowed.
  const nlohmann::json& required(const std::string& key, const std::string& allowed);

  static constexpr double kNoLimit = std::numeric_limits<double>::infinity();
  /// A finite number from `minimum` to `maximum`; with `open` strictly between.
  double number(const std::string& key, double minimum = -kNoLimit, double maximum = kNoLimit,
                bool open = false);
  double numberOr(const std::string& key, double otherwise, double minimum = -kNoLimit,
                  double maximum = kNoLimit, bool open = false);
  int integer(const std::string& key, int minimum, int maximum);
  int integerOr(const std::string& key, int otherwise, int minimum, int maximum);
  std::string textOr(const std::string& key, const std::string& otherwise);
  std::string choiceOr(const std::string& key, const std::string& otherwise,
                       const std::vector<std::string>& choices);

  /// Refuses keys that were never read.
  void finish() const;

 private:
  const nlohmann::json& settings_;
  std::string where_;
  std::vector<std::string> known_;
};

/// Stimulus dimensions with their values: one object {name, ...} or a list of them; see
/// psychometrics::readAxis for the other keys. A single one may be unnamed and is called "stimulus".
std::vector<psychometrics::GridAxis> readStimulusAxes(const nlohmann::json& json, const std::string& where);
nlohmann::json toJson(const std::vector<psychometrics::GridAxis>& axes);

/// `stop`: {trials, entropy, reversals, sd}, those named in `allowed`. 0 if not given.
struct StopRule {
  int trials = 0, reversals = 0;
  double entropy = 0.0, sd = 0.0;
};
/// At least one must be given.
StopRule readStop(SettingsReader& reader, const std::vector<std::string>& allowed);
nlohmann::json toJson(const StopRule& stop);

/// Checks a trial: `dimensions` finite numbers and an outcome from 0 to outcomes - 1. Throws Error.
void checkTrial(const std::vector<double>& stimulus, int outcome, size_t dimensions, int outcomes);

}  // namespace limen::study
