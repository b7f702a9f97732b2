// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "analysis/output/text_output.h"
#include "analysis/output/text_table.h"
#include "analysis/relations/areas.h"
#include "analysis/relations/relation_text.h"

namespace limen::analysis {
namespace {

std::string tableOfAreas(const AreaGroup& group, const std::string& level, bool clusters) {
  std::vector<std::vector<std::string>> table = {{"x", "area", level, level + " (logit)"}};
  if (clusters) table[0].push_back(level + " bootstrap");
  std::string notes;
  for (const ColumnArea& one : group.areas) {
    table.push_back({one.x, fixedText(one.area.area), intervalText(one.area.interval),
                     intervalText(one.area.logitInterval)});
    if (clusters) table.back().push_back(intervalText(boundsOf(one.bootstrap)));
    if (notes.empty() && one.bootstrap && one.bootstrap->undefined > 0)
      notes = fmt::format("    {} samples of the bootstrap had outcomes of one kind and are left out\n",
                          one.bootstrap->undefined);
  }
  return alignedText(table, {0}, "    ") + notes;
}

std::string tableOfDifferences(const AreaGroup& group, const std::string& level, bool clusters) {
  const bool several = group.differences.size() > 1;
  std::vector<std::vector<std::string>> table = {{"", "", "difference", level, "z", "p"}};
  if (several) table[0].push_back("p (Holm)");
  if (clusters) table[0].push_back(level + " bootstrap");
  for (const AreaDifference& one : group.differences) {
    const RocComparison& c = one.comparison;
    table.push_back({one.first, "- " + one.second, fixedText(c.difference), intervalText(c.interval),
                     fixedText(c.z), pText(c.p)});
    if (several) table.back().push_back(pText(one.holm));
    if (clusters) table.back().push_back(intervalText(boundsOf(one.bootstrap)));
  }
  return alignedText(table, {0, 1}, "    ");
}

std::string calibrationText(const ColumnCalibration& column, const std::string& level) {
  const Calibration& c = column.calibration;
  std::string out = fmt::format(
      "\n    calibration of {}: Brier score {:.4f}\n      = reliability {:.4f} - resolution {:.4f} + "
      "uncertainty "
      "{:.4f} + within bins {:.4f}\n",
      column.x, c.brier, c.reliability, c.resolution, c.uncertainty, c.withinVariance - c.withinCovariance);
  std::vector<std::vector<std::string>> table = {
      {"predicted", "rows", "mean", "observed", level + " (Wilson)"}};
  for (const CalibrationBin& bin : c.bins)
    if (bin.trials > 0)
      table.push_back({fmt::format("{:.4g} to {:.4g}", bin.low, bin.high), std::to_string(bin.trials),
                       fixedText(bin.meanPrediction), fixedText(bin.observed), intervalText(bin.wilson)});
  return out + alignedText(table, {0}, "      ");
}

nlohmann::json calibrationJson(const ColumnCalibration& column) {
  const Calibration& c = column.calibration;
  nlohmann::json bins = nlohmann::json::array();
  for (const CalibrationBin& bin : c.bins)
    bins.push_back({{"low", bin.low},
                    {"high", bin.high},
                    {"rows", bin.trials},
                    {"positive", bin.positives},
                    {"mean_prediction", bin.trials > 0 ? nlohmann::json(bin.meanPrediction) : nullptr},
                    {"observed", bin.trials > 0 ? nlohmann::json(bin.observed) : nullptr},
                    {"wilson", intervalJson(bin.wilson)}});
  return {{"x", column.x},
          {"brier", c.brier},
          {"reliability", c.reliability},
          {"resolution", c.resolution},
          {"uncertainty", c.uncertainty},
          {"within_variance", c.withinVariance},
          {"within_covariance", c.withinCovariance},
          {"bins", bins}};
}

nlohmann::json groupJson(const AreaGroup& group) {
  nlohmann::json areas = nlohmann::json::array(), differences = nlohmann::json::array(),
                 calibrations = nlohmann::json::array();
  for (const ColumnArea& one : group.areas)
    areas.push_back({{"x", one.x},
                     {"area", one.area.area},
                     {"variance", numberJson(one.area.variance)},
                     {"interval", intervalJson(one.area.interval)},
                     {"logit_interval", intervalJson(one.area.logitInterval)},
                     {"bootstrap_interval", intervalJson(boundsOf(one.bootstrap))}});
  for (const AreaDifference& one : group.differences)
    differences.push_back({{"first", one.first},
                           {"second", one.second},
                           {"difference", one.comparison.difference},
                           {"interval", intervalJson(one.comparison.interval)},
                           {"z", numberJson(one.comparison.z)},
                           {"p", numberJson(one.comparison.p)},
                           {"p_holm", numberJson(one.holm)},
                           {"bootstrap_interval", intervalJson(boundsOf(one.bootstrap))}});
  for (const ColumnCalibration& one : group.calibrations) calibrations.push_back(calibrationJson(one));
  return {{"group", group.name},          {"rows", group.rows},  {"positives", group.positives},
          {"clusters", group.clusters},   {"areas", areas},      {"differences", differences},
          {"calibrations", calibrations}, {"notes", group.notes}};
}

}  // namespace

std::string toText(const Areas& areas) {
  const std::string level = levelText(areas.setting.bootstrap.level);
  const bool clusters = !areas.cluster.empty();
  std::string out = fmt::format(
      "Area under the ROC curve = P(x of a row with {0} 1 is above x of a row with 0), ties half.\n{1} "
      "intervals "
      "and p after DeLong, DeLong and Clarke-Pearson (1988); (logit): better next to 0 and 1. They\ntake "
      "rows as "
      "independent. p (Holm): adjusted for the pairs of a group.\n",
      areas.outcome, level);
  out += bootstrapText(areas.cluster, areas.setting.bootstrap);
  for (const AreaGroup& group : areas.groups) {
    out += "\n" + groupText(group.name, fmt::format("{} rows, {} is 1 in {}", group.rows, areas.outcome,
                                                    group.positives));
    out += clusters ? fmt::format(", {} different {}\n", group.clusters, areas.cluster) : "\n";
    if (!group.areas.empty()) out += tableOfAreas(group, level, clusters);
    if (!group.differences.empty()) out += "\n" + tableOfDifferences(group, level, clusters);
    for (const ColumnCalibration& one : group.calibrations) out += calibrationText(one, level);
    for (const std::string& note : group.notes) out += "    " + note + "\n";
  }
  return out + "\n-: cannot be told, or of no width, which is no certainty.\n";
}

nlohmann::json toJson(const Areas& areas) {
  nlohmann::json groups = nlohmann::json::array();
  for (const AreaGroup& group : areas.groups) groups.push_back(groupJson(group));
  const BootstrapSetting& bootstrap = areas.setting.bootstrap;
  return {{"level", bootstrap.level},
          {"outcome", areas.outcome},
          {"bootstrap", bootstrapJson(areas.cluster, bootstrap)},
          {"groups", groups}};
}

std::string toCsv(const Areas& areas) {
  std::string out = csvLine({"group", "kind", "x", "minus", "value", "low", "high", "p", "p_holm",
                             "bootstrap_low", "bootstrap_high", "bin_low", "bin_high", "rows"});
  for (const AreaGroup& group : areas.groups) {
    for (const ColumnArea& one : group.areas) {
      const auto drawn = boundsOf(one.bootstrap);
      out += csvLine({group.name, "area", one.x, "", cellText(one.area.area),
                      cellText(lowOf(one.area.interval)), cellText(highOf(one.area.interval)), "", "",
                      cellText(lowOf(drawn)), cellText(highOf(drawn)), "", "", std::to_string(group.rows)});
    }
    for (const AreaDifference& one : group.differences) {
      const auto drawn = boundsOf(one.bootstrap);
      const RocComparison& c = one.comparison;
      out += csvLine({group.name, "difference", one.first, one.second, cellText(c.difference),
                      cellText(lowOf(c.interval)), cellText(highOf(c.interval)), cellText(c.p),
                      cellText(one.holm), cellText(lowOf(drawn)), cellText(highOf(drawn)), "", "",
                      std::to_string(group.rows)});
    }
    for (const ColumnCalibration& one : group.calibrations) {
      out += csvLine({group.name, "brier", one.x, "", cellText(one.calibration.brier), "", "", "", "", "", "",
                      "", "", std::to_string(group.rows)});
      for (const CalibrationBin& bin : one.calibration.bins)
        if (bin.trials > 0)
          out += csvLine({group.name, "observed", one.x, "", cellText(bin.observed),
                          cellText(lowOf(bin.wilson)), cellText(highOf(bin.wilson)), "", "", "", "",
                          cellText(bin.low), cellText(bin.high), std::to_string(bin.trials)});
    }
  }
  return out;
}

}  // namespace limen::analysis
