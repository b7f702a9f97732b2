// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/relations/relation_text.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "experiments/base/text.h"

namespace limen::analysis {

std::string levelText(double level) { return fmt::format("{:.4g} %", 100.0 * level); }

std::string bootstrapText(const std::string& cluster, const BootstrapSetting& setting) {
  if (cluster.empty()) return {};
  return fmt::format(
      "Bootstrap: percentile intervals; rows that are alike in '{}' are drawn together, {} samples, seed {}. "
      "Where\nthere are several such rows, these are the intervals to report: the others, and p, are too "
      "sure.\n",
      cluster, setting.samples, setting.seed);
}

nlohmann::json bootstrapJson(const std::string& cluster, const BootstrapSetting& setting) {
  if (cluster.empty()) return {};
  return {
      {"over", cluster}, {"interval", "percentile"}, {"samples", setting.samples}, {"seed", setting.seed}};
}

std::optional<Interval> boundsOf(const std::optional<ResampledInterval>& bootstrap) {
  return bootstrap ? bootstrap->interval : std::nullopt;
}

std::optional<double> lowOf(const std::optional<Interval>& interval) {
  return interval ? std::optional<double>(interval->low) : std::nullopt;
}

std::optional<double> highOf(const std::optional<Interval>& interval) {
  return interval ? std::optional<double>(interval->high) : std::nullopt;
}

std::string groupText(const std::string& name, const std::string& rest) {
  return name.empty() ? rest : name + ": " + rest;
}

}  // namespace limen::analysis
