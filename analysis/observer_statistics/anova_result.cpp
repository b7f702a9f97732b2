// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>

#include "analysis/observer_statistics/anova.h"
#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

/// An effect and what was published of it.
struct EffectRow {
  const AnovaEffect* own;
  const std::optional<PublishedEffect>* published;
};

std::string publishedText(const std::optional<PublishedEffect>& published) {
  if (!published) return "";
  return fmt::format("F({:g},{:g}) {} {}, p {}{}", published->df, published->dfError,
                     published->fDerived ? "about" : "=", published->f, published->p[0] == '<' ? "" : "= ",
                     published->p);
}

bool isInfinite(const std::optional<double>& value) { return value && std::isinf(*value); }

ResultTable effectTable(const PartAnova& part) {
  std::vector<EffectRow> rows;
  for (size_t i = 0; part.result && i < part.result->effects.size(); ++i)
    rows.push_back({&part.result->effects[i], &part.published[i]});
  const auto of = [](auto member) { return at(&EffectRow::own, member); };
  const auto sphericity = [](auto member) { return at(&EffectRow::own, &AnovaEffect::sphericity, member); };
  const auto published = [](auto member) { return at(&EffectRow::published, member); };
  TableOf out("effects", "", rows);
  out.add(text("effect"), of(&AnovaEffect::name))
      .add(number("f", "F"), of(&AnovaEffect::f))
      .add(forData(flag("f_infinite")), [](const EffectRow& row) { return isInfinite(row.own->f); })
      .add(significant("df"), of(&AnovaEffect::df))
      .add(significant("df_error"), of(&AnovaEffect::dfError))
      .add(probability(), of(&AnovaEffect::p))
      .add(forData(number("sum_of_squares")), of(&AnovaEffect::sumOfSquares))
      .add(forData(number("error_sum_of_squares")), of(&AnovaEffect::errorSumOfSquares))
      .add(number("partial_eta_squared", "partial η²"), of(&AnovaEffect::partialEtaSquared))
      .add(interval("partial_eta_squared"), of(&AnovaEffect::partialEtaSquaredInterval))
      .add(number("generalised_eta_squared", "generalised η²"), of(&AnovaEffect::generalisedEtaSquared))
      .add(ifAny(number("mauchly_w", "Mauchly's W")), sphericity(&Sphericity::mauchlyW))
      .add(ifAny(probability("mauchly_p", "p (W)")), sphericity(&Sphericity::mauchlyP))
      .add(ifAny(number("greenhouse_geisser", "GG ε")), sphericity(&Sphericity::greenhouseGeisser))
      .add(ifAny(probability("p_greenhouse_geisser", "p (GG)")), sphericity(&Sphericity::pGreenhouseGeisser))
      .add(ifAny(number("huynh_feldt", "HF ε")), sphericity(&Sphericity::huynhFeldt))
      .add(ifAny(probability("p_huynh_feldt", "p (HF)")), sphericity(&Sphericity::pHuynhFeldt))
      .add(ifAny(forPeople(text("", "published"))),
           [](const EffectRow& row) { return publishedText(*row.published); })
      .add(forData(number("published_f")), published(&PublishedEffect::f))
      .add(forData(flag("published_f_derived")), published(&PublishedEffect::fDerived))
      .add(forData(number("published_df")), published(&PublishedEffect::df))
      .add(forData(number("published_df_error")), published(&PublishedEffect::dfError))
      .add(forData(text("published_p")), published(&PublishedEffect::p))
      .add(forData(text("published_remark")), published(&PublishedEffect::remark))
      .add(forData(text("published_source")), published(&PublishedEffect::source))
      .add(forData(text("note")), of(&AnovaEffect::note));
  return out;
}

/// Rates are of the order of 1, other values of any size.
Column value(const PartAnova& part, const std::string& name, const std::string& title = {}) {
  return part.rates ? number(name, title) : significant(name, title);
}
Column valueInterval(const PartAnova& part) {
  Column out = interval();
  if (!part.rates) out.kind = Kind::Interval, out.digits = 4;
  return out;
}

void addLevels(const PartAnova& part, size_t f, Section& out) {
  const FactorComparison& comparison = part.comparisons[f];
  const NamedFactor& factor = part.factors[f];
  std::vector<size_t> levels(factor.levels.size());
  for (size_t i = 0; i < levels.size(); ++i) levels[i] = i;
  const auto mean = [&](auto member) {
    return [&, member](size_t i) { return comparison.means[i].*member; };
  };
  out.add(TableOf("levels", "levels of " + factor.name + ", means over the other factors", levels)
              .add(forData(text("factor")), [&](size_t) { return factor.name; })
              .add(text("level", factor.name), [&](size_t i) { return factor.levels[i]; })
              .add(value(part, "estimate", "mean"), mean(&MeanOverSubjects::mean))
              .add(valueInterval(part), mean(&MeanOverSubjects::interval))
              .add(value(part, "sd"), mean(&MeanOverSubjects::standardDeviation))
              .addIf(comparison.friedman.has_value(), number("mean_rank", "", 2),
                     [&](size_t i) { return comparison.friedman->meanRanks[i]; }));
}

void addPairs(const PartAnova& part, size_t f, Section& out) {
  const FactorComparison& comparison = part.comparisons[f];
  const NamedFactor& factor = part.factors[f];
  const auto level = [&](auto member) {
    return [&, member](const auto& pair) { return factor.levels[pair.*member]; };
  };
  out.add(TableOf("pairs", "pairs of levels of " + factor.name + ", first minus second, paired t tests",
                  comparison.pairs)
              .add(forData(text("factor")), [&](const auto&) { return factor.name; })
              .add(text("first"), level(&PairedComparison::first))
              .add(text("second"), level(&PairedComparison::second))
              .add(value(part, "estimate", "difference"), &PairedComparison::difference)
              .add(valueInterval(part), &PairedComparison::interval)
              .add(number("t"), &PairedComparison::t)
              .add(forData(flag("t_infinite")), [](const auto& pair) { return std::isinf(pair.t); })
              .add(significant("df"), &PairedComparison::df)
              .add(probability(), &PairedComparison::p)
              .add(probability("p_holm", "p (Holm)"), &PairedComparison::pHolm)
              .add(number("d_z", "d_z"), &PairedComparison::standardisedDifference));
  if (!comparison.friedman) return;
  const double df = static_cast<double>(comparison.friedman->treatments) - 1.0;
  out.add(TableOf("friedman", "Friedman's test of " + factor.name,
                  std::vector<FriedmanTest>{*comparison.friedman})
              .add(text("factor"), [&](const auto&) { return factor.name; })
              .add(number("chi_squared", "χ²"), &FriedmanTest::chiSquared)
              .add(significant("df"), [&](const auto&) { return df; })
              .add(probability(), &FriedmanTest::p)
              .add(number("f", "F"), &FriedmanTest::f)
              .add(forData(flag("f_infinite")), [](const auto& test) { return isInfinite(test.f); })
              .add(significant("df_error"),
                   [&](const auto& test) { return df * (static_cast<double>(test.subjects) - 1.0); })
              .add(probability("p_f", "p (F)"), &FriedmanTest::fP)
              .add(number("kendall_w", "Kendall's W"), &FriedmanTest::kendallW));
  const auto test = [](auto member) { return at(&RankComparison::test, member); };
  out.add(TableOf("rank_pairs", "pairs of levels of " + factor.name + ", Wilcoxon's signed ranks",
                  comparison.rankPairs)
              .add(forData(text("factor")), [&](const auto&) { return factor.name; })
              .add(text("first"), level(&RankComparison::first))
              .add(text("second"), level(&RankComparison::second))
              .add(significant("v", "V"), test(&SignedRankTest::positiveRanks))
              .add(integer("differing", "differ"), test(&SignedRankTest::pairs))
              .add(probability(), test(&SignedRankTest::p))
              .add(flag("exact"), test(&SignedRankTest::exact))
              .add(probability("p_holm", "p (Holm)"), &RankComparison::pHolm)
              .add(number("rank_biserial", "r"), test(&SignedRankTest::rankBiserial)));
}

void addNotes(const PartAnova& part, Section& out) {
  if (!part.note.empty()) out.notes.push_back("no analysis: " + part.note);
  if (!part.incomplete.empty())
    out.notes.push_back("without an answer in some condition, left out: " + join(part.incomplete));
  if (!part.result) return;
  if (part.unequalReplicates)
    out.notes.push_back("conditions have unequal numbers of answers: analysis of unweighted means");
  if (part.transform != RateTransform::None)
    out.notes.push_back("rates p are transformed, asin(sqrt(p)): means and differences are in radians");
  else if (part.rates)
    out.notes.push_back(
        "rates are not transformed; intervals of their means are t intervals on the logit scale");
  std::string source;
  for (size_t i = 0; i < part.result->effects.size(); ++i) {
    const AnovaEffect& effect = part.result->effects[i];
    if (!effect.note.empty()) out.notes.push_back(effect.name + ": " + effect.note);
    const std::optional<PublishedEffect>& published = part.published[i];
    if (!published) continue;
    if (!published->remark.empty())
      out.notes.push_back("published " + effect.name + ": " + published->remark);
    source = "published: " + published->source + ", without correction for sphericity";
  }
  if (!source.empty()) out.notes.push_back(source);
}

}  // namespace

Section sectionOf(const PartAnova& part) {
  Section out;
  out.title = (part.part.empty() ? "" : "part " + part.part + ", ") + part.measure;
  out.fact(key(text("part")), part.part.empty() ? ResultCell() : ResultCell(part.part));
  out.fact(forData(text("measure")), part.measure);
  out.fact(forData(text("rate_of")), part.rates ? ResultCell(part.of) : ResultCell());
  out.fact(text("transform"), toText(part.transform));
  out.fact(integer("observers"), part.result ? part.result->subjects : 0);
  out.fact(
      part.rates && part.transform == RateTransform::None ? share("grand_mean") : significant("grand_mean"),
      part.result ? ResultCell(part.result->grandMean) : ResultCell());
  out.fact(forData(list("incomplete_observers")), part.incomplete);
  out.fact(forData(flag("unequal_replicates")), part.unequalReplicates);
  out.fact(forData(text("note")), part.note);
  out.add(TableOf("factors", "", part.factors)
              .add(text("factor", "factor within subjects"), &NamedFactor::name)
              .add(list("levels"), &NamedFactor::levels));
  out.add(effectTable(part));
  for (size_t f = 0; f < part.comparisons.size(); ++f) {
    addLevels(part, f, out);
    addPairs(part, f, out);
  }
  addNotes(part, out);
  return out;
}

Result resultOf(const std::vector<PartAnova>& parts) {
  Result out;
  out.command = "anova";
  bool ranks = false, sphericity = false;
  for (const PartAnova& part : parts) {
    out.sections.push_back(sectionOf(part));
    for (const FactorComparison& comparison : part.comparisons) ranks = ranks || comparison.friedman;
    for (size_t i = 0; part.result && i < part.result->effects.size(); ++i)
      sphericity = sphericity || part.result->effects[i].sphericity;
  }
  out.notes = {
      "partial η² with its 95 % interval; p (Holm): adjusted over the pairs of a factor; d_z: mean "
      "difference over its sd"};
  if (sphericity)
    out.notes.push_back(
        "p (GG), p (HF): of F with the degrees of freedom times that epsilon; p (W): Mauchly's test");
  if (ranks)
    out.notes.push_back(
        "V: Wilcoxon's sum of signed ranks where first is larger, of the subjects who differ; r: "
        "rank-biserial correlation; p not exact: normal approximation (ties, equal pairs or more than "
        "50 pairs)");
  return out;
}

}  // namespace limen::analysis
