// SPDX-License-Identifier: BSD-3-Clause
// Analysis of variance of detection rates, pairs of levels, published statistics beside.
#include <fmt/format.h>

#include <algorithm>

#include "analysis/output/result_renderers.h"
#include "analysis/output/text_output.h"
#include "analysis/study_page/sections.h"

namespace limen::analysis {
namespace {

constexpr size_t kOpenPairs = 12;

void addPart(const PartAnova& part, const Section& section, PageWriter& out) {
  std::vector<std::string> factors;
  for (const NamedFactor& factor : part.factors)
    factors.push_back(fmt::format("{} ({} levels)", factor.name, factor.levels.size()));
  out.table(
      section.table("effects"),
      fmt::format("Repeated-measures analysis of variance of part {}: {}, of {}, factors {}. p without "
                  "correction, and with Greenhouse and Geisser's (GG) and Huynh and Feldt's (HF) correction "
                  "for effects of more than one degree of freedom, W being Mauchly's; partial η² with its "
                  "95 % interval.",
                  part.part, part.measure, counted(part.result->subjects, "observer"), listed(factors)),
      "tables/anova.csv");
  out.list(section.notes);
  size_t factor = 0;
  for (const ResultTable& table : section.tables) {
    if (table.name != "pairs") continue;
    const std::string& name = part.factors[factor++].name;
    // One pair says what the analysis of variance said.
    if (table.rows() < 2) continue;
    out.table(
        table,
        "Pairs of levels of " + name + " in part " + part.part +
            ", other factors averaged: paired t tests over observers, p with Holm's correction over the "
            "pairs "
            "of this factor. Differences are first minus second, with 95 % intervals that are not corrected.",
        "tables/anova.csv", kOpenPairs);
  }
}

}  // namespace

void addAnova(const StudyPage& page, PageWriter& out) {
  if (std::none_of(page.anova.begin(), page.anova.end(),
                   [](const PartAnova& part) { return part.result.has_value(); }))
    return;
  out.openSection("anova", "Analysis of variance");
  const Result result = resultOf(page.anova);
  for (size_t i = 0; i < page.anova.size(); ++i) {
    if (page.anova.size() > 1) out.heading("Part " + page.anova[i].part);
    if (page.anova[i].result)
      addPart(page.anova[i], result.sections[i], out);
    else
      out.list(result.sections[i].notes);
  }
  out.file("tables/anova.csv", toCsv(result.sections), "analysis of variance, pairs of levels");
  out.closeSection();
}

}  // namespace limen::analysis
