// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "analysis/output/text_output.h"
#include "analysis/output/text_table.h"
#include "analysis/relations/relation_text.h"
#include "analysis/relations/scale.h"

namespace limen::analysis {
namespace {

std::string modelText(const ScaleSetting& setting) {
  std::string out = "Bradley and Terry's model: P(i over j) = 1 / (1 + exp(s_j - s_i)), maximum likelihood";
  if (setting.model != PairwiseModel::kBradleyTerry)
    out = std::string("Thurstone's case V: P(i over j) = Phi(s_i - s_j), ") +
          (setting.model == PairwiseModel::kThurstoneLeastSquares ? "least squares (Mosteller 1951)"
                                                                  : "maximum likelihood");
  return out + "\n" + (setting.reference.empty() ? "values sum to 0" : "'" + setting.reference + "' is 0") +
         "; 1 apart: " + percentText(predictPreference(setting.model, 1.0)) + " prefer the upper\n";
}

std::string bootstrapName(ScaleBootstrap bootstrap) {
  return bootstrap == ScaleBootstrap::Subjects ? "subjects" : "judgements";
}

std::string itemTable(const ItemScale& scale, const ScaleSetting& setting) {
  const std::string level = levelText(setting.bootstrap.level);
  const bool drawn = scale.bootstrap != ScaleBootstrap::None, shares = !setting.reference.empty();
  std::vector<std::vector<std::string>> table = {{"item", "chosen", "value", "error", level}};
  if (drawn) table[0].push_back(level + " bootstrap");
  if (shares) {
    table[0].push_back("over " + setting.reference);
    table[0].push_back(drawn ? level + " bootstrap" : level);
  }
  for (const ScaledItem& one : scale.items) {
    table.push_back({one.name, fmt::format("{}/{}", one.chosen, one.judged), fixedText(one.value),
                     fixedText(one.standardError), intervalText(one.interval)});
    if (drawn) table.back().push_back(intervalText(boundsOf(one.bootstrap)));
    if (shares) {
      table.back().push_back(one.preferred ? percentText(*one.preferred) : "-");
      table.back().push_back(intervalText(one.preferredInterval, true));
    }
  }
  return alignedText(table, {0}, "  ");
}

std::string stepTable(const ItemScale& scale, const ScaleSetting& setting) {
  const std::string level = levelText(setting.bootstrap.level);
  const bool drawn = scale.bootstrap != ScaleBootstrap::None, several = scale.steps.size() > 1;
  std::vector<std::vector<std::string>> table = {
      {"", "", "difference", "error", level, "z", "p", "preferred", "chosen"}};
  if (several) table[0].insert(table[0].begin() + 7, "p (Holm)");
  if (drawn) table[0].push_back(level + " bootstrap");
  for (const ItemStep& one : scale.steps) {
    table.push_back({one.upper, "- " + one.lower, fixedText(one.difference), fixedText(one.standardError),
                     intervalText(one.interval), fixedText(one.z, 2), pText(one.p),
                     percentText(one.preferred),
                     one.judged > 0 ? fmt::format("{}/{}", one.chosen, one.judged) : "-"});
    if (several) table.back().insert(table.back().begin() + 7, pText(one.holm));
    if (drawn) table.back().push_back(intervalText(boundsOf(one.bootstrap)));
  }
  return alignedText(table, {0, 1}, "    ");
}

std::string goodnessText(const PairwiseScale& fit) {
  std::string out = fmt::format("  goodness of fit, {} pairs: deviance {:.3f}, Pearson's X2 {:.3f}",
                                fit.pairsJudged, fit.deviance, fit.pearson);
  if (fit.df == 0) return out + "; as many values as pairs\n";
  out += fmt::format(", {} degrees of freedom", fit.df);
  if (fit.devianceP) out += fmt::format(", p = {} and {}", pText(fit.devianceP), pText(fit.pearsonP));
  return out + "\n";
}

std::string consistencyText(const ItemScale& scale) {
  const auto judgedAll = std::count_if(scale.consistency.begin(), scale.consistency.end(),
                                       [](const SubjectConsistency& one) { return one.rounds > 0; });
  if (scale.consistency.empty()) return {};
  if (judgedAll == 0) return "  nobody judged each pair exactly once: no circular triads\n";
  const auto items = static_cast<int64_t>(scale.items.size());
  std::string out = fmt::format(
      "\n  circular triads (Kendall and Babington Smith 1940): at most {}, {:.4g} of answers at random\n",
      mostCircularTriads(items), expectedCircularTriads(items));
  std::vector<std::vector<std::string>> table = {{"subject", "rounds", "triads", "consistency"}};
  for (const SubjectConsistency& one : scale.consistency)
    table.push_back({one.subject, std::to_string(one.rounds),
                     one.rounds > 0 ? fmt::format("{:.4g}", one.triads) : "-",
                     one.rounds > 0 ? fixedText(one.coefficient) : "-"});
  return out + alignedText(table, {0}, "    ");
}

std::string groupScaleText(const ItemScale& scale, const ScaleSetting& setting) {
  std::string out = fmt::format("\n{}{} items, {} judgements", scale.name.empty() ? "" : scale.name + ": ",
                                scale.items.size(), scale.judgements);
  if (scale.subjects > 0) out += fmt::format(" of {} subjects", scale.subjects);
  out += "\n" + itemTable(scale, setting);
  if (!scale.fit.note.empty()) out += "  penalised: " + scale.fit.note + "\n";
  if (scale.bootstrap != ScaleBootstrap::None)
    out +=
        fmt::format("  bootstrap over {}: {} samples, seed {}{}{}\n", bootstrapName(scale.bootstrap),
                    setting.bootstrap.samples, setting.bootstrap.seed,
                    scale.penalised > 0 ? fmt::format("; {} unbounded and penalised", scale.penalised) : "",
                    scale.skipped > 0 ? fmt::format("; {} not connected and left out", scale.skipped) : "");
  out += "\n  neighbours\n" + stepTable(scale, setting) + "\n" + goodnessText(scale.fit);
  if (scale.firstChosen)
    out += fmt::format("  shown first and chosen: {}/{} = {}, {}\n", scale.firstChosen->successes,
                       scale.firstChosen->trials, percentText(scale.firstChosen->rate),
                       intervalText(scale.firstChosen->wilson, true));
  for (const std::string& note : scale.notes) out += "  " + note + "\n";
  return out + consistencyText(scale);
}

nlohmann::json consistencyJson(const ItemScale& scale) {
  nlohmann::json out = nlohmann::json::array();
  for (const SubjectConsistency& one : scale.consistency)
    out.push_back({{"subject", one.subject},
                   {"rounds", one.rounds},
                   {"circular_triads", one.rounds > 0 ? nlohmann::json(one.triads) : nullptr},
                   {"consistency", one.rounds > 0 ? nlohmann::json(one.coefficient) : nullptr}});
  return out;
}

nlohmann::json groupScaleJson(const ItemScale& scale, const ScaleSetting& setting) {
  nlohmann::json items = nlohmann::json::array(), steps = nlohmann::json::array();
  for (const ScaledItem& one : scale.items)
    items.push_back({{"item", one.name},
                     {"chosen", one.chosen},
                     {"judged", one.judged},
                     {"value", one.value},
                     {"standard_error", numberJson(one.standardError)},
                     {"interval", intervalJson(one.interval)},
                     {"bootstrap_interval", intervalJson(boundsOf(one.bootstrap))},
                     {"preferred", numberJson(one.preferred)},
                     {"preferred_interval", intervalJson(one.preferredInterval)}});
  for (const ItemStep& one : scale.steps)
    steps.push_back({{"upper", one.upper},
                     {"lower", one.lower},
                     {"difference", one.difference},
                     {"standard_error", one.standardError},
                     {"interval", intervalJson(one.interval)},
                     {"bootstrap_interval", intervalJson(boundsOf(one.bootstrap))},
                     {"z", numberJson(one.z)},
                     {"p", numberJson(one.p)},
                     {"p_holm", numberJson(one.holm)},
                     {"preferred", one.preferred},
                     {"chosen", one.chosen},
                     {"judged", one.judged}});
  nlohmann::json bootstrap;
  if (scale.bootstrap != ScaleBootstrap::None)
    bootstrap = {{"over", bootstrapName(scale.bootstrap)}, {"interval", "percentile"},
                 {"samples", setting.bootstrap.samples},   {"seed", setting.bootstrap.seed},
                 {"penalised", scale.penalised},           {"skipped", scale.skipped}};
  nlohmann::json first;
  if (scale.firstChosen)
    first = {{"chosen", scale.firstChosen->successes},
             {"judged", scale.firstChosen->trials},
             {"wilson", intervalJson(scale.firstChosen->wilson)}};
  return {{"group", scale.name},
          {"subjects", scale.subjects},
          {"judgements", scale.judgements},
          {"items", items},
          {"steps", steps},
          {"penalised", scale.fit.penalised},
          {"note", scale.fit.note},
          {"log_likelihood", numberJson(scale.fit.logLikelihood)},
          {"pairs_judged", scale.fit.pairsJudged},
          {"df", scale.fit.df},
          {"deviance", numberJson(scale.fit.deviance)},
          {"deviance_p", numberJson(scale.fit.devianceP)},
          {"pearson", numberJson(scale.fit.pearson)},
          {"pearson_p", numberJson(scale.fit.pearsonP)},
          {"bootstrap", bootstrap},
          {"first_chosen", first},
          {"consistency", consistencyJson(scale)},
          {"notes", scale.notes}};
}

}  // namespace

std::string toText(const Scales& scales) {
  std::string out = modelText(scales.setting);
  for (const ItemScale& scale : scales.groups) out += groupScaleText(scale, scales.setting);
  for (const std::string& note : scales.notes) out += "\n" + note + "\n";
  return out + "\n" + levelText(scales.setting.bootstrap.level) +
         " beside an error: value +- z error, from the inverse Hessian (least squares: delta method), which "
         "takes\n"
         "judgements as independent. Those of one subject are not: a bootstrap over subjects is the one to "
         "report "
         "then.\np (Holm): adjusted for the neighbours of a scale, whose order comes of the same "
         "judgements.\n-: "
         "cannot be told, or of no width, which is no certainty.\n";
}

nlohmann::json toJson(const Scales& scales) {
  nlohmann::json groups = nlohmann::json::array();
  for (const ItemScale& scale : scales.groups) groups.push_back(groupScaleJson(scale, scales.setting));
  const ScaleSetting& setting = scales.setting;
  return {{"model", modelName(setting.model)},
          {"level", setting.bootstrap.level},
          {"reference", setting.reference.empty() ? nlohmann::json() : nlohmann::json(setting.reference)},
          {"groups", groups},
          {"notes", scales.notes}};
}

std::string toCsv(const Scales& scales) {
  std::string out =
      csvLine({"group", "kind", "item", "minus", "value", "standard_error", "low", "high", "bootstrap_low",
               "bootstrap_high", "p", "p_holm", "preferred", "chosen", "judged"});
  for (const ItemScale& scale : scales.groups) {
    for (const ScaledItem& one : scale.items) {
      const auto drawn = boundsOf(one.bootstrap);
      out += csvLine({scale.name, "item", one.name, scales.setting.reference, cellText(one.value),
                      cellText(one.standardError), cellText(lowOf(one.interval)),
                      cellText(highOf(one.interval)), cellText(lowOf(drawn)), cellText(highOf(drawn)), "", "",
                      cellText(one.preferred), std::to_string(one.chosen), std::to_string(one.judged)});
    }
    for (const ItemStep& one : scale.steps) {
      const auto drawn = boundsOf(one.bootstrap);
      out += csvLine({scale.name, "step", one.upper, one.lower, cellText(one.difference),
                      cellText(one.standardError), cellText(one.interval.low), cellText(one.interval.high),
                      cellText(lowOf(drawn)), cellText(highOf(drawn)), cellText(one.p), cellText(one.holm),
                      cellText(one.preferred), std::to_string(one.chosen), std::to_string(one.judged)});
    }
  }
  return out;
}

}  // namespace limen::analysis
