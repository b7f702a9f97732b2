// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/groups/anova.h"
#include "analysis/output/text_table.h"

namespace limen::analysis {
namespace {

using nlohmann::json;

json effectJson(const AnovaEffect& effect, const std::optional<PublishedEffect>& published) {
  json out = {{"effect", effect.name},
              {"f", numberJson(effect.f)},
              {"f_infinite", effect.f && std::isinf(*effect.f)},
              {"df", effect.df},
              {"df_error", effect.dfError},
              {"p", numberJson(effect.p)},
              {"sum_of_squares", effect.sumOfSquares},
              {"error_sum_of_squares", effect.errorSumOfSquares},
              {"partial_eta_squared", numberJson(effect.partialEtaSquared)},
              {"partial_eta_squared_95", intervalJson(effect.partialEtaSquaredInterval)},
              {"generalised_eta_squared", numberJson(effect.generalisedEtaSquared)},
              {"note", effect.note},
              {"published", nullptr}};
  if (effect.sphericity) {
    const Sphericity& s = *effect.sphericity;
    out["greenhouse_geisser"] = s.greenhouseGeisser;
    out["p_greenhouse_geisser"] = s.pGreenhouseGeisser;
    out["huynh_feldt"] = s.huynhFeldt;
    out["p_huynh_feldt"] = s.pHuynhFeldt;
    out["mauchly_w"] = numberJson(s.mauchlyW);
    out["mauchly_p"] = numberJson(s.mauchlyP);
  }
  if (published)
    out["published"] = {{"f", published->f},          {"f_derived", published->fDerived},
                        {"df", published->df},        {"df_error", published->dfError},
                        {"p", published->p},          {"remark", published->remark},
                        {"source", published->source}};
  return out;
}

json comparisonJson(const NamedFactor& factor, const FactorComparison& comparison) {
  json levels = json::array(), pairs = json::array(), rankPairs = json::array();
  for (size_t i = 0; i < comparison.means.size(); ++i) {
    const MeanOverSubjects& mean = comparison.means[i];
    levels.push_back({{"level", factor.levels[i]},
                      {"mean", mean.mean},
                      {"sd", numberJson(mean.standardDeviation)},
                      {"mean_95", intervalJson(mean.interval)}});
  }
  for (const PairedComparison& pair : comparison.pairs)
    pairs.push_back({{"first", factor.levels[pair.first]},
                     {"second", factor.levels[pair.second]},
                     {"difference", pair.difference},
                     {"difference_95", intervalJson(pair.interval)},
                     {"t", numberJson(pair.t)},
                     {"t_infinite", std::isinf(pair.t)},
                     {"df", pair.df},
                     {"p", pair.p},
                     {"p_holm", pair.pHolm},
                     {"d_z", numberJson(pair.standardisedDifference)}});
  json out = {{"factor", factor.name}, {"levels", levels}, {"pairs", pairs}};
  if (!comparison.friedman) return out;
  const FriedmanTest& test = *comparison.friedman;
  const double df = static_cast<double>(test.treatments) - 1.0;
  for (const RankComparison& pair : comparison.rankPairs)
    rankPairs.push_back({{"first", factor.levels[pair.first]},
                         {"second", factor.levels[pair.second]},
                         {"v", pair.test.positiveRanks},
                         {"differing", pair.test.pairs},
                         {"p", pair.test.p},
                         {"exact", pair.test.exact},
                         {"p_holm", pair.pHolm},
                         {"rank_biserial", pair.test.rankBiserial}});
  out["friedman"] = {{"chi_squared", numberJson(test.chiSquared)},
                     {"df", df},
                     {"p", numberJson(test.p)},
                     {"f", numberJson(test.f)},
                     {"f_infinite", test.f && std::isinf(*test.f)},
                     {"df_error", df * (static_cast<double>(test.subjects) - 1.0)},
                     {"f_p", numberJson(test.fP)},
                     {"kendall_w", numberJson(test.kendallW)},
                     {"mean_ranks", test.meanRanks}};
  out["rank_pairs"] = rankPairs;
  return out;
}

}  // namespace

json toJson(const std::vector<PartAnova>& parts) {
  json out = json::array();
  for (const PartAnova& part : parts) {
    json effects = json::array(), factors = json::array(), comparisons = json::array();
    for (const NamedFactor& factor : part.factors)
      factors.push_back({{"name", factor.name}, {"levels", factor.levels}});
    for (size_t i = 0; part.result && i < part.result->effects.size(); ++i)
      effects.push_back(effectJson(part.result->effects[i], part.published[i]));
    for (size_t i = 0; i < part.comparisons.size(); ++i)
      comparisons.push_back(comparisonJson(part.factors[i], part.comparisons[i]));
    out.push_back({{"part", part.part.empty() ? json() : json(part.part)},
                   {"measure", part.measure},
                   {"rate_of", part.rates ? json(part.of) : json()},
                   {"transform", part.transform == RateTransform::Arcsine ? "arcsine" : "none"},
                   {"factors", factors},
                   {"observers", part.result ? part.result->subjects : 0},
                   {"grand_mean", part.result ? json(part.result->grandMean) : json()},
                   {"incomplete_observers", part.incomplete},
                   {"unequal_replicates", part.unequalReplicates},
                   {"note", part.note},
                   {"effects", effects},
                   {"comparisons", comparisons}});
  }
  return out;
}

}  // namespace limen::analysis
