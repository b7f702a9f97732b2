// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>

#include "analysis/groups/anova.h"
#include "analysis/output/text_table.h"
#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string publishedText(const std::optional<PublishedEffect>& published) {
  if (!published) return "";
  return fmt::format("F({:g},{:g}) {} {}, p {}{}", published->df, published->dfError,
                     published->fDerived ? "about" : "=", published->f, published->p[0] == '<' ? "" : "= ",
                     published->p);
}

/// Rates are of the order of 1, other values of any size.
std::string valueText(const PartAnova& part, double value) {
  return part.rates ? fixedText(value) : fmt::format("{:.4g}", value);
}

std::string rangeText(const PartAnova& part, const std::optional<Interval>& interval) {
  if (!interval || interval->low == interval->high) return "-";
  return valueText(part, interval->low) + " to " + valueText(part, interval->high);
}

std::string heading(const PartAnova& part) {
  std::string out = "\n" + (part.part.empty() ? "" : "part " + part.part + ", ") + part.measure + "\n";
  if (!part.note.empty()) out += "  no analysis: " + part.note + "\n";
  if (!part.incomplete.empty())
    out += "  without an answer in some condition, left out: " + join(part.incomplete) + "\n";
  if (!part.result) return out;
  if (part.unequalReplicates)
    out += "  conditions have unequal numbers of answers: analysis of unweighted means\n";
  std::vector<std::string> factors;
  for (const NamedFactor& factor : part.factors)
    factors.push_back(fmt::format("{} ({})", factor.name, factor.levels.size()));
  const bool transformed = part.transform != RateTransform::None;
  out += fmt::format("  {} subjects, within factors {}, mean {}\n", part.result->subjects, join(factors),
                     part.rates && !transformed ? percentText(part.result->grandMean)
                                                : valueText(part, part.result->grandMean));
  if (transformed)
    out += "  rates p are transformed, asin(sqrt(p)): means and differences are in radians\n";
  else if (part.rates)
    out += "  rates are not transformed\n";
  return out;
}

std::string effectLines(const PartAnova& part) {
  const bool published = std::any_of(part.published.begin(), part.published.end(),
                                     [](const auto& one) { return one.has_value(); });
  Rows table = {{"effect", "F", "df", "p", "eta2p", "95 %", "eta2G"}};
  if (published) table[0].push_back("published");
  std::string remarks, source;
  for (size_t i = 0; i < part.result->effects.size(); ++i) {
    const AnovaEffect& effect = part.result->effects[i];
    table.push_back({effect.name, fixedText(effect.f), fmt::format("{:g},{:g}", effect.df, effect.dfError),
                     pText(effect.p), fixedText(effect.partialEtaSquared),
                     intervalText(effect.partialEtaSquaredInterval),
                     fixedText(effect.generalisedEtaSquared)});
    if (published) table.back().push_back(publishedText(part.published[i]));
    if (!effect.note.empty()) remarks += "  " + effect.name + ": " + effect.note + "\n";
    if (!part.published[i]) continue;
    if (!part.published[i]->remark.empty())
      remarks += "  published " + effect.name + ": " + part.published[i]->remark + "\n";
    source = "  published: " + part.published[i]->source + ", without correction for sphericity\n";
  }
  return alignedText(table, {0, 7}) +
         "  eta2p, eta2G: partial eta squared with its interval, generalised eta squared\n" + remarks +
         source;
}

std::string sphericityLines(const PartAnova& part) {
  Rows table = {{"sphericity", "Mauchly's W", "p", "GG epsilon", "p (GG)", "HF epsilon", "p (HF)"}};
  for (const AnovaEffect& effect : part.result->effects)
    if (const auto& s = effect.sphericity)
      table.push_back({effect.name, fixedText(s->mauchlyW), pText(s->mauchlyP),
                       fixedText(s->greenhouseGeisser), pText(s->pGreenhouseGeisser),
                       fixedText(s->huynhFeldt), pText(s->pHuynhFeldt)});
  if (table.size() == 1) return {};
  return "\n" + alignedText(table, {0}) +
         "  p (GG), p (HF): of F with the degrees of freedom times that epsilon\n";
}

std::string meanLines(const PartAnova& part, size_t factor) {
  const FactorComparison& comparison = part.comparisons[factor];
  Rows table = {{part.factors[factor].name, "mean", "sd", "95 %"}};
  if (comparison.friedman) table[0].push_back("mean rank");
  for (size_t i = 0; i < comparison.means.size(); ++i) {
    const MeanOverSubjects& mean = comparison.means[i];
    table.push_back({part.factors[factor].levels[i], valueText(part, mean.mean),
                     mean.standardDeviation ? valueText(part, *mean.standardDeviation) : "-",
                     rangeText(part, mean.interval)});
    if (comparison.friedman) table.back().push_back(fixedText(comparison.friedman->meanRanks[i], 2));
  }
  return "\n" + alignedText(table, {0});
}

std::string pairLines(const PartAnova& part, size_t factor) {
  const FactorComparison& comparison = part.comparisons[factor];
  const std::vector<std::string>& levels = part.factors[factor].levels;
  Rows table = {{"first", "second", "difference", "95 %", "t", "df", "p", "p (Holm)", "d_z"}};
  for (const PairedComparison& pair : comparison.pairs)
    table.push_back({levels[pair.first], levels[pair.second], valueText(part, pair.difference),
                     rangeText(part, pair.interval), fixedText(pair.t), fmt::format("{:g}", pair.df),
                     pText(pair.p), pText(pair.pHolm), fixedText(pair.standardisedDifference)});
  return "\n" + alignedText(table, {0, 1}, "    ");
}

std::string rankLines(const PartAnova& part, size_t factor) {
  const FactorComparison& comparison = part.comparisons[factor];
  if (!comparison.friedman) return {};
  const FriedmanTest& test = *comparison.friedman;
  const double df = static_cast<double>(test.treatments) - 1.0;
  std::string out = fmt::format(
      "\n    Friedman: chi2({:g}) = {}, p {}; F({:g},{:g}) = {}, p {}; Kendall's W {}\n", df,
      fixedText(test.chiSquared), pText(test.p), df, df * (static_cast<double>(test.subjects) - 1.0),
      fixedText(test.f), pText(test.fP), fixedText(test.kendallW));
  const std::vector<std::string>& levels = part.factors[factor].levels;
  Rows table = {{"first", "second", "V", "differ", "p", "p (Holm)", "r"}};
  bool exact = true;
  for (const RankComparison& pair : comparison.rankPairs) {
    exact = exact && pair.test.exact;
    table.push_back({levels[pair.first], levels[pair.second], fmt::format("{:g}", pair.test.positiveRanks),
                     std::to_string(pair.test.pairs), (pair.test.exact ? "" : "~ ") + pText(pair.test.p),
                     pText(pair.pHolm), fixedText(pair.test.rankBiserial)});
  }
  out += alignedText(table, {0, 1}, "    ");
  if (!exact) out += "    ~ by the normal approximation: ties, equal pairs or more than 50 pairs\n";
  return out;
}

std::string comparisonLines(const PartAnova& part) {
  std::string out;
  for (size_t factor = 0; factor < part.comparisons.size(); ++factor)
    out += meanLines(part, factor) + pairLines(part, factor) + rankLines(part, factor);
  if (out.empty()) return out;
  out +=
      "\n  levels: means over the other factors; differences: first minus second, paired t tests;\n"
      "  p (Holm): adjusted over the pairs of a factor; d_z: mean difference over its sd\n";
  if (part.comparisons[0].friedman)
    out +=
        "  V: Wilcoxon's sum of signed ranks where first is larger, of the subjects who differ;\n"
        "  r: rank-biserial correlation\n";
  return out;
}

}  // namespace

std::string toText(const std::vector<PartAnova>& parts) {
  std::string out;
  for (const PartAnova& part : parts) {
    out += heading(part);
    if (part.result) out += effectLines(part) + sphericityLines(part) + comparisonLines(part);
  }
  return out;
}

}  // namespace limen::analysis
