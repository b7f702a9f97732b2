// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/correlations/bootstrap_facts.h"

#include <fmt/format.h>

namespace limen::analysis {

std::string levelText(double level) { return fmt::format("{:.4g} %", 100.0 * level); }

void addBootstrapFacts(Section& out, const std::string& over, const BootstrapSetting& setting) {
  out.fact(forData(number("level")), setting.level);
  if (over.empty()) return;
  out.fact(text("bootstrap_over"), over);
  out.fact(integer("samples"), setting.samples);
  out.fact(integer("seed"), setting.seed);
}

std::string bootstrapNote(const std::string& cluster) {
  if (cluster.empty()) return {};
  return "bootstrap: percentile intervals; rows that are alike in '" + cluster +
         "' are drawn together. Where there are several such rows, these are the intervals to report: the "
         "others, and p, are too sure";
}

std::optional<Interval> boundsOf(const std::optional<ResampledInterval>& bootstrap) {
  return bootstrap ? bootstrap->interval : std::nullopt;
}

}  // namespace limen::analysis
