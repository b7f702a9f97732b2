// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "analysis/study/anova.h"
#include "analysis/output/text_table.h"
#include "analysis/output/text_output.h"
#include "base/text.h"

namespace limen::analysis {
namespace {

std::string publishedText(const std::optional<PublishedEffect>& published) {
  if (!published) return "";
  return fmt::format("F({:g},{:g}) {} {}, p {}{}", published->df, published->dfError,
                     published->fDerived ? "about" : "=", published->f, published->p[0] == '<' ? "" : "= ",
                     published->p);
}

}  // namespace

std::string toText(const std::vector<PartAnova>& parts) {
  std::string out;
  for (const PartAnova& part : parts) {
    out += "\npart " + part.part + ", rate of '" + part.of + "' in trials with a change\n";
    if (!part.note.empty()) out += "  no analysis: " + part.note + "\n";
    if (!part.incomplete.empty())
      out += "  without an answer in some condition, left out: " + join(part.incomplete) + "\n";
    if (!part.result) continue;
    if (part.unequalReplicates)
      out += "  conditions have unequal numbers of answers: analysis of unweighted means\n";
    std::vector<std::string> factors;
    for (const StudyFactor& factor : part.factors)
      factors.push_back(fmt::format("{} ({})", factor.name, factor.levels.size()));
    out += fmt::format("  {} observers, within factors {}, mean {}\n", part.result->subjects, join(factors),
                       percentText(part.result->grandMean));
    std::vector<std::vector<std::string>> table = {
        {"effect", "F", "df", "p", "GG eps", "p (GG)", "eta2p", "eta2G", "published"}};
    std::string remarks;
    for (size_t i = 0; i < part.result->effects.size(); ++i) {
      const AnovaEffect& effect = part.result->effects[i];
      const auto& sphericity = effect.sphericity;
      table.push_back({effect.name, fixedText(effect.f), fmt::format("{:g},{:g}", effect.df, effect.dfError),
                       pText(effect.p), sphericity ? fixedText(sphericity->greenhouseGeisser) : "-",
                       sphericity ? pText(sphericity->pGreenhouseGeisser) : "-",
                       fixedText(effect.partialEtaSquared), fixedText(effect.generalisedEtaSquared),
                       publishedText(part.published[i])});
      if (!effect.note.empty()) remarks += "  " + effect.name + ": " + effect.note + "\n";
      if (part.published[i] && !part.published[i]->remark.empty())
        remarks += "  published " + effect.name + ": " + part.published[i]->remark + "\n";
    }
    out += alignedText(table, {0, 8}) + remarks;
    for (const auto& published : part.published)
      if (published) {
        out += "  published: " + published->source +
               "; GG: Greenhouse and Geisser's correction, which it did "
               "not use\n";
        break;
      }
  }
  return out;
}

nlohmann::json toJson(const std::vector<PartAnova>& parts) {
  nlohmann::json out = nlohmann::json::array();
  for (const PartAnova& part : parts) {
    nlohmann::json effects = nlohmann::json::array(), factors = nlohmann::json::array();
    for (const StudyFactor& factor : part.factors)
      factors.push_back({{"name", factor.name}, {"levels", factor.levels}});
    for (size_t i = 0; part.result && i < part.result->effects.size(); ++i) {
      const AnovaEffect& effect = part.result->effects[i];
      nlohmann::json one = {{"effect", effect.name},
                            {"f", numberJson(effect.f)},
                            {"f_infinite", effect.f && *effect.f > 1e300},
                            {"df", effect.df},
                            {"df_error", effect.dfError},
                            {"p", numberJson(effect.p)},
                            {"partial_eta_squared", numberJson(effect.partialEtaSquared)},
                            {"partial_eta_squared_95", intervalJson(effect.partialEtaSquaredInterval)},
                            {"generalised_eta_squared", numberJson(effect.generalisedEtaSquared)},
                            {"note", effect.note},
                            {"published", nullptr}};
      if (effect.sphericity) {
        const Sphericity& s = *effect.sphericity;
        one["greenhouse_geisser"] = s.greenhouseGeisser;
        one["p_greenhouse_geisser"] = s.pGreenhouseGeisser;
        one["huynh_feldt"] = s.huynhFeldt;
        one["p_huynh_feldt"] = s.pHuynhFeldt;
        one["mauchly_w"] = numberJson(s.mauchlyW);
        one["mauchly_p"] = numberJson(s.mauchlyP);
      }
      if (const auto& published = part.published[i])
        one["published"] = {{"f", published->f},          {"f_derived", published->fDerived},
                            {"df", published->df},        {"df_error", published->dfError},
                            {"p", published->p},          {"remark", published->remark},
                            {"source", published->source}};
      effects.push_back(one);
    }
    out.push_back({{"part", part.part},
                   {"rate_of", part.of},
                   {"factors", factors},
                   {"observers", part.result ? part.result->subjects : 0},
                   {"grand_mean", part.result ? nlohmann::json(part.result->grandMean) : nlohmann::json()},
                   {"incomplete_observers", part.incomplete},
                   {"unequal_replicates", part.unequalReplicates},
                   {"note", part.note},
                   {"effects", effects}});
  }
  return out;
}

std::string toCsv(const std::vector<PartAnova>& parts) {
  std::string out =
      csvLine({"part", "effect", "f", "df", "df_error", "p", "greenhouse_geisser", "p_greenhouse_geisser",
               "partial_eta_squared", "generalised_eta_squared", "published_f", "published_p"});
  for (const PartAnova& part : parts)
    for (size_t i = 0; part.result && i < part.result->effects.size(); ++i) {
      const AnovaEffect& effect = part.result->effects[i];
      const auto& sphericity = effect.sphericity;
      const auto& published = part.published[i];
      out +=
          csvLine({part.part, effect.name, cellText(effect.f), cellText(effect.df), cellText(effect.dfError),
                   cellText(effect.p), sphericity ? cellText(sphericity->greenhouseGeisser) : "",
                   sphericity ? cellText(sphericity->pGreenhouseGeisser) : "",
                   cellText(effect.partialEtaSquared), cellText(effect.generalisedEtaSquared),
                   published ? cellText(published->f) : "", published ? published->p : ""});
    }
  return out;
}

}  // namespace limen::analysis
