// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "analysis/output/text_output.h"
#include "analysis/output/text_table.h"
#include "analysis/relations/correlations.h"
#include "analysis/relations/relation_text.h"

namespace limen::analysis {
namespace {

std::string shownName(const std::string& name) {
  static const std::vector<std::string> kShown = {"Kendall tau_a", "Kendall tau_b", "Kendall tau_c",
                                                  "Spearman",      "Pearson",       "Pearson, clamped"};
  const auto& names = coefficientNames();
  return kShown[static_cast<size_t>(std::find(names.begin(), names.end(), name) - names.begin())];
}

std::string relationText(const Relation& relation, const Correlations& all, bool several, bool clusters) {
  std::string out =
      fmt::format("  {} against {}, {} {}\n", relation.x, relation.y, relation.xs.size(), all.unit);
  const std::string& why = relation.coefficients.front().reason;
  if (!why.empty()) return out + "    no coefficients: " + why + "\n";
  const std::string level = levelText(all.setting.bootstrap.level);
  std::vector<std::vector<std::string>> table = {{"", "value", level, "p", ""}};
  if (several) table[0].push_back("p (Holm)");
  if (clusters) table[0].push_back(level + " bootstrap");
  std::vector<std::string> notes;
  for (const RelationCoefficient& one : relation.coefficients) {
    if (!one.coefficient) {
      table.push_back({shownName(one.name), "-", one.reason});
      continue;
    }
    table.push_back({shownName(one.name), fixedText(one.coefficient->value),
                     intervalText(one.coefficient->interval), pText(one.p), one.exact ? "exact" : ""});
    if (several) table.back().push_back(pText(one.holm));
    if (clusters) table.back().push_back(intervalText(boundsOf(one.bootstrap)));
    if (one.bootstrap && one.bootstrap->undefined > 0)
      notes.push_back(fmt::format("    {} was undefined in {} samples of the bootstrap\n",
                                  shownName(one.name), one.bootstrap->undefined));
  }
  out += alignedText(table, {0, 4}, "    ");
  if (relation.clamp)
    out += fmt::format("    clamped: {} of {}, lowered to {}\n", relation.clamped, relation.xs.size(),
                       formatNumber(*relation.clamp));
  else if (relation.coefficients.size() == coefficientNames().size())
    out += "    clamped: none, as no rate is 1\n";
  for (const std::string& note : notes) out += note;
  return out;
}

}  // namespace

std::string toText(const Correlations& correlations) {
  const bool clusters = !correlations.cluster.empty();
  std::string out = fmt::format(
      "{} intervals: Kendall's value +- z error (tau_a after Samara and Randles 1988, tau_b and tau_c after "
      "Brown\n"
      "and Benedetti 1977), Spearman's and Pearson's by Fisher's z. They and the two-sided p take {} as\n"
      "independent. p (Holm): adjusted for the pairs of a group, each coefficient apart.\n",
      levelText(correlations.setting.bootstrap.level), correlations.unit);
  out += bootstrapText(correlations.cluster, correlations.setting.bootstrap);
  if (clusters) out += "None for tau_a and tau_c, which rows drawn twice pull towards 0.\n";
  if (correlations.setting.clamp)
    out += "Clamped: x above the least whose rate is 1 are lowered to it (Schwarz 2009, section 10.4.1).\n";
  for (const CorrelationGroup& group : correlations.groups) {
    out += "\n";
    if (!group.name.empty()) out += group.name + "\n";
    if (clusters) out += fmt::format("  {} different {}\n", group.clusters, correlations.cluster);
    const bool several = group.relations.size() > 1;
    for (const Relation& relation : group.relations)
      out += (&relation == &group.relations.front() ? "" : "\n") +
             relationText(relation, correlations, several, clusters);
    for (const std::string& note : group.notes) out += "  " + note + "\n";
  }
  for (const std::string& note : correlations.notes) out += "\n" + note + "\n";
  return out + "\n-: cannot be told, or of no width, which is no certainty.\n";
}

nlohmann::json toJson(const Correlations& correlations) {
  nlohmann::json groups = nlohmann::json::array();
  for (const CorrelationGroup& group : correlations.groups) {
    nlohmann::json relations = nlohmann::json::array();
    for (const Relation& relation : group.relations) {
      nlohmann::json coefficients = nlohmann::json::object();
      for (const RelationCoefficient& one : relation.coefficients) {
        const auto& c = one.coefficient;
        coefficients[one.name] = {
            {"value", numberJson(c ? std::optional<double>(c->value) : std::nullopt)},
            {"standard_error", numberJson(c ? c->standardError : std::nullopt)},
            {"interval", intervalJson(c ? c->interval : std::nullopt)},
            {"p", numberJson(one.p)},
            {"p_exact", one.exact},
            {"p_holm", numberJson(one.holm)},
            {"bootstrap_interval", intervalJson(boundsOf(one.bootstrap))},
            {"bootstrap_undefined", one.bootstrap ? nlohmann::json(one.bootstrap->undefined) : nullptr},
            {"reason", one.reason}};
      }
      relations.push_back({{"x", relation.x},
                           {"y", relation.y},
                           {"n", relation.xs.size()},
                           {"clamp", numberJson(relation.clamp)},
                           {"clamped", relation.clamped},
                           {"coefficients", coefficients}});
    }
    groups.push_back({{"group", group.name},
                      {"clusters", group.clusters},
                      {"relations", relations},
                      {"notes", group.notes}});
  }
  const BootstrapSetting& bootstrap = correlations.setting.bootstrap;
  return {{"level", bootstrap.level},
          {"unit", correlations.unit},
          {"bootstrap", bootstrapJson(correlations.cluster, bootstrap)},
          {"groups", groups},
          {"notes", correlations.notes}};
}

std::string toCsv(const Correlations& correlations) {
  std::string out = csvLine({"group", "x", "y", "n", "coefficient", "value", "standard_error", "low", "high",
                             "p", "p_exact", "p_holm", "bootstrap_low", "bootstrap_high", "reason"});
  for (const CorrelationGroup& group : correlations.groups)
    for (const Relation& relation : group.relations)
      for (const RelationCoefficient& one : relation.coefficients) {
        const auto& c = one.coefficient;
        const auto interval = c ? c->interval : std::nullopt;
        const auto drawn = boundsOf(one.bootstrap);
        out += csvLine({group.name, relation.x, relation.y, std::to_string(relation.xs.size()), one.name,
                        cellText(c ? std::optional<double>(c->value) : std::nullopt),
                        cellText(c ? c->standardError : std::nullopt), cellText(lowOf(interval)),
                        cellText(highOf(interval)), cellText(one.p), one.p ? (one.exact ? "1" : "0") : "",
                        cellText(one.holm), cellText(lowOf(drawn)), cellText(highOf(drawn)), one.reason});
      }
  return out;
}

}  // namespace limen::analysis
