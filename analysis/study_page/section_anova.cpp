// SPDX-License-Identifier: BSD-3-Clause
// Analysis of variance of detection rates, pairs of levels, published statistics beside.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/output/text_output.h"
#include "analysis/output/text_table.h"
#include "analysis/study_page/sections.h"
#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

constexpr size_t kOpenAnovaRows = 12;

/// Broken between F and p only.
std::string publishedText(const PublishedEffect& published) {
  std::string f = fmt::format("F({:g}, {:g}) {} {},", published.df, published.dfError,
                              published.fDerived ? "≈" : "=", shortestNumber(published.f));
  std::string p = std::string("p ") + (published.p[0] == '<' ? "" : "= ") + published.p;
  replaceAll(f, " ", "\u00a0");
  replaceAll(p, " ", "\u00a0");
  return f + " " + p;
}

std::optional<double> finite(double value) {
  return std::isfinite(value) ? std::optional<double>(value) : std::nullopt;
}

void addEffects(const PartAnova& part, PageWriter& out) {
  PageTable table;
  table.file = "tables/anova.csv";
  table.columns = {{"effect", false}, {"F"},      {"df"},         {"p"},    {"GG ε"},          {"p (GG)"},
                   {"HF ε"},          {"p (HF)"}, {"partial η²"}, {"95 %"}, {"generalised η²"}};
  std::string source;
  for (const auto& published : part.published)
    if (published) source = published->source;
  if (!source.empty()) table.columns.push_back({"published", false});
  std::vector<std::string> remarks;
  for (size_t i = 0; i < part.result->effects.size(); ++i) {
    const AnovaEffect& effect = part.result->effects[i];
    const auto& sphericity = effect.sphericity;
    table.rows.push_back(
        {effect.name, fixedText(effect.f), fmt::format("{:g}, {:g}", effect.df, effect.dfError),
         pText(effect.p), sphericity ? fixedText(sphericity->greenhouseGeisser) : "-",
         sphericity ? pText(sphericity->pGreenhouseGeisser) : "-",
         sphericity ? fixedText(sphericity->huynhFeldt) : "-",
         sphericity ? pText(sphericity->pHuynhFeldt) : "-", fixedText(effect.partialEtaSquared),
         intervalText(effect.partialEtaSquaredInterval), fixedText(effect.generalisedEtaSquared)});
    if (!source.empty())
      table.rows.back().push_back(part.published[i] ? publishedText(*part.published[i]) : "");
    if (!effect.note.empty()) remarks.push_back(effect.name + ": " + effect.note);
    if (part.published[i] && !part.published[i]->remark.empty())
      remarks.push_back("Published " + effect.name + ": " + part.published[i]->remark);
  }
  std::vector<std::string> factors;
  for (const auto& factor : part.factors)
    factors.push_back(fmt::format("{} ({} levels)", factor.name, factor.levels.size()));
  table.caption = fmt::format(
      "Repeated-measures analysis of variance of part {}: rates of ‘{}’ in trials with a change of {}, "
      "factors {}. "
      "p without correction, and with Greenhouse and Geisser's (GG) and Huynh and Feldt's (HF) correction "
      "for "
      "effects of more than one degree of freedom; partial η² with its 95 % interval.{}",
      part.part, part.of, counted(part.result->subjects, "observer"), listed(factors),
      source.empty() ? "" : " Published: " + source + ", without correction.");
  out.table(table);
  out.list(remarks);
}

void addComparisons(const PartAnova& part, PageWriter& out, std::string& csv) {
  for (size_t f = 0; f < part.comparisons.size(); ++f) {
    const auto& factor = part.factors[f];
    PageTable table;
    table.caption =
        "Pairs of levels of " + factor.name + " in part " + part.part +
        ", other factors averaged: paired t tests over observers, p with Holm's correction over the "
        "pairs of this factor. Differences of rates in percentage points, with 95 % intervals that "
        "are not corrected.";
    table.file = "tables/comparisons.csv";
    table.columns = {
        {"first", false}, {"second", false}, {"difference"}, {"95 %"}, {"t"}, {"df"}, {"p"}, {"p (Holm)"},
        {"d_z"}};
    for (const PairedComparison& pair : part.comparisons[f].pairs) {
      const std::string &first = factor.levels[pair.first], &second = factor.levels[pair.second];
      const bool wide = pair.interval.low != pair.interval.high;
      table.rows.push_back(
          {first, second, fixedText(100.0 * pair.difference, 1),
           wide ? fmt::format("{:.1f} to {:.1f}", 100.0 * pair.interval.low, 100.0 * pair.interval.high)
                : "-",
           fixedText(pair.t, 2), fmt::format("{:g}", pair.df), pText(pair.p), pText(pair.pHolm),
           fixedText(pair.standardisedDifference, 2)});
      csv += csvLine({part.part, factor.name, first, second, cellText(pair.difference),
                      cellText(pair.interval.low), cellText(pair.interval.high), cellText(finite(pair.t)),
                      cellText(pair.df), cellText(pair.p), cellText(pair.pHolm),
                      cellText(pair.standardisedDifference)});
    }
    table.folded = table.rows.size() > kOpenAnovaRows;
    // One pair says what the analysis of variance said.
    if (table.rows.size() > 1) out.table(table);
  }
}

}  // namespace

void addAnova(const StudyPage& page, PageWriter& out) {
  if (std::none_of(page.anova.begin(), page.anova.end(),
                   [](const PartAnova& part) { return part.result.has_value(); }))
    return;
  out.openSection("anova", "Analysis of variance");
  std::string pairs = csvLine(
      {"part", "factor", "first", "second", "difference", "low", "high", "t", "df", "p", "p_holm", "d_z"});
  for (const PartAnova& part : page.anova) {
    if (page.anova.size() > 1) out.heading("Part " + part.part);
    if (!part.note.empty()) out.paragraph("No analysis: " + part.note + ".");
    if (!part.incomplete.empty())
      out.paragraph("Without an answer in some condition, and so left out of this analysis: " +
                    join(part.incomplete) + ".");
    if (!part.result) continue;
    if (part.unequalReplicates)
      out.paragraph("Conditions have unequal numbers of answers: this is an analysis of unweighted means.");
    addEffects(part, out);
    addComparisons(part, out, pairs);
  }
  out.file("tables/anova.csv", toCsv(page.anova), "analysis of variance");
  out.file("tables/comparisons.csv", pairs, "pairs of levels of each factor");
  out.closeSection();
}

}  // namespace limen::analysis
