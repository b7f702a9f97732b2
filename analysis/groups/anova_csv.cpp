// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <map>

#include "analysis/groups/anova.h"
#include "analysis/output/text_output.h"
#include "analysis/output/text_table.h"

namespace limen::analysis {
namespace {

/// A line of CSV by the names of its fields.
class Line {
 public:
  static const std::vector<std::string>& columns() {
    static const std::vector<std::string> kColumns = {"part",
                                                      "kind",
                                                      "effect",
                                                      "first",
                                                      "second",
                                                      "f",
                                                      "df",
                                                      "df_error",
                                                      "p",
                                                      "p_holm",
                                                      "partial_eta_squared",
                                                      "partial_eta_squared_low",
                                                      "partial_eta_squared_high",
                                                      "generalised_eta_squared",
                                                      "mauchly_w",
                                                      "mauchly_p",
                                                      "greenhouse_geisser",
                                                      "p_greenhouse_geisser",
                                                      "huynh_feldt",
                                                      "p_huynh_feldt",
                                                      "published_f",
                                                      "published_p",
                                                      "estimate",
                                                      "low",
                                                      "high",
                                                      "sd",
                                                      "t",
                                                      "d_z",
                                                      "chi_squared",
                                                      "kendall_w",
                                                      "v",
                                                      "rank_biserial"};
    return kColumns;
  }
  Line& set(const std::string& column, const std::string& value) {
    values_[column] = value;
    return *this;
  }
  Line& set(const std::string& column, const std::optional<double>& value) {
    return set(column, cellText(value && std::isfinite(*value) ? value : std::nullopt));
  }
  Line& set(const std::string& low, const std::string& high, const std::optional<Interval>& interval) {
    if (!interval) return *this;
    return set(low, interval->low).set(high, interval->high);
  }
  std::string text() const {
    std::vector<std::string> fields;
    for (const std::string& column : columns()) {
      const auto own = values_.find(column);
      fields.push_back(own == values_.end() ? "" : own->second);
    }
    return csvLine(fields);
  }

 private:
  std::map<std::string, std::string> values_;
};

Line lineOf(const PartAnova& part, const std::string& kind, const std::string& effect) {
  Line out;
  out.set("part", part.part).set("kind", kind).set("effect", effect);
  return out;
}

std::string effectLine(const PartAnova& part, size_t i) {
  const AnovaEffect& effect = part.result->effects[i];
  Line line = lineOf(part, "effect", effect.name);
  line.set("f", effect.f)
      .set("df", effect.df)
      .set("df_error", effect.dfError)
      .set("p", effect.p)
      .set("partial_eta_squared", effect.partialEtaSquared)
      .set("partial_eta_squared_low", "partial_eta_squared_high", effect.partialEtaSquaredInterval)
      .set("generalised_eta_squared", effect.generalisedEtaSquared);
  if (const auto& s = effect.sphericity)
    line.set("mauchly_w", s->mauchlyW)
        .set("mauchly_p", s->mauchlyP)
        .set("greenhouse_geisser", s->greenhouseGeisser)
        .set("p_greenhouse_geisser", s->pGreenhouseGeisser)
        .set("huynh_feldt", s->huynhFeldt)
        .set("p_huynh_feldt", s->pHuynhFeldt);
  if (const auto& published = part.published[i])
    line.set("published_f", published->f).set("published_p", published->p);
  return line.text();
}

std::string comparisonLines(const PartAnova& part, size_t factor) {
  const FactorComparison& comparison = part.comparisons[factor];
  const std::string& name = part.factors[factor].name;
  const std::vector<std::string>& levels = part.factors[factor].levels;
  std::string out;
  for (size_t i = 0; i < levels.size(); ++i) {
    const MeanOverSubjects& mean = comparison.means[i];
    out += lineOf(part, "level", name)
               .set("first", levels[i])
               .set("estimate", mean.mean)
               .set("low", "high", mean.interval)
               .set("sd", mean.standardDeviation)
               .text();
  }
  const auto pairOf = [&](const std::string& kind, size_t first, size_t second) {
    return lineOf(part, kind, name).set("first", levels[first]).set("second", levels[second]);
  };
  for (const PairedComparison& pair : comparison.pairs)
    out += pairOf("pair", pair.first, pair.second)
               .set("estimate", pair.difference)
               .set("low", "high", pair.interval)
               .set("t", pair.t)
               .set("df", pair.df)
               .set("p", pair.p)
               .set("p_holm", pair.pHolm)
               .set("d_z", pair.standardisedDifference)
               .text();
  if (!comparison.friedman) return out;
  const FriedmanTest& test = *comparison.friedman;
  out += lineOf(part, "friedman", name)
             .set("chi_squared", test.chiSquared)
             .set("df", static_cast<double>(test.treatments) - 1.0)
             .set("p", test.p)
             .set("kendall_w", test.kendallW)
             .text();
  for (const RankComparison& pair : comparison.rankPairs)
    out += pairOf("rank_pair", pair.first, pair.second)
               .set("v", pair.test.positiveRanks)
               .set("p", pair.test.p)
               .set("p_holm", pair.pHolm)
               .set("rank_biserial", pair.test.rankBiserial)
               .text();
  return out;
}

}  // namespace

std::string toCsv(const std::vector<PartAnova>& parts) {
  std::string out = csvLine(Line::columns());
  for (const PartAnova& part : parts) {
    for (size_t i = 0; part.result && i < part.result->effects.size(); ++i) out += effectLine(part, i);
    for (size_t i = 0; i < part.comparisons.size(); ++i) out += comparisonLines(part, i);
  }
  return out;
}

}  // namespace limen::analysis
