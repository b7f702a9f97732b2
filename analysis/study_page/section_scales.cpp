// SPDX-License-Identifier: BSD-3-Clause
// Items that were compared in pairs: their values on a scale.
#include <fmt/format.h>

#include <algorithm>

#include "analysis/correlations/cluster_bootstrap.h"
#include "analysis/output/result_renderers.h"
#include "analysis/output/text_output.h"
#include "analysis/study_page/sections.h"
#include "experiments/base/build_facts.h"
#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

constexpr const char* kScaleFile = "tables/scales.csv";

/// What the figure's bars are: the bootstrap's intervals where there are any.
std::optional<Interval> shownInterval(const ScaledItem& item) {
  const std::optional<Interval> drawn = boundsOf(item.bootstrap);
  return drawn ? drawn : item.interval;
}

std::string intervalKind(const ItemScale& scale) {
  return scale.bootstrap == ScaleBootstrap::None ? "95 % intervals, value ± z standard errors"
                                                 : "95 % intervals of a bootstrap over observers";
}

void addScaleFigure(const StudyPage& page, const PartScale& part, PageWriter& out) {
  const ItemScale& scale = *part.scale;
  Figure figure;
  figure.name = "scale_" + page.stem(part.part);
  figure.key = false;
  figure.xTitle = "scale value";
  figure.description = "scale values of the items of part " + part.part + ", the highest at the top";
  figure.heightPx = 120 + 36 * static_cast<int>(scale.items.size());
  std::vector<std::vector<double>> rows;
  std::vector<std::pair<double, std::string>> labels;
  double place = static_cast<double>(scale.items.size());
  for (const ScaledItem& item : scale.items) {
    const Interval bar = shownInterval(item).value_or(Interval{item.value, item.value});
    labels.emplace_back(place, item.name);
    rows.push_back({item.value, place, bar.low, bar.high});
    place -= 1.0;
  }
  const double top = static_cast<double>(scale.items.size()) + 0.5;
  figure.settings = namedTics("y", labels) + fmt::format("set yrange [0.5:{}]\n", shortestNumber(top)) +
                    "set offsets graph 0.05, graph 0.05, 0, 0\n";
  figure.plots.push_back(addBlock(figure, "zero, which values sum to", {{0.0, 0.5}, {0.0, top}}) +
                         " using 1:2 with lines " + kReferenceLook);
  figure.plots.push_back(addBlock(figure, "value, place, interval from, to", rows) +
                         " using 1:2:3:4 with xerrorbars pt 7 ps 0.8 lw 1.5 " + seriesColour(0));
  out.figure(figure,
             fmt::format("Part {}: scale values of the items; bars are {}.", part.part, intervalKind(scale)));
}

std::vector<std::string> remarksOnScale(const StudyPart& part, const ItemScale& scale) {
  std::vector<std::string> out = sectionOf(scale, {}).notes, pooled;
  for (const StudyFactor& factor : part.factors)
    if (factor.name != "item_a" && factor.name != "item_b") pooled.push_back(factor.name);
  if (!pooled.empty()) out.push_back("pooled over " + join(pooled));
  if (scale.subjects > 1)
    out.push_back(fmt::format(
        "standard errors and z tests take all judgements of {} observers as independent, which makes errors "
        "and p too small{}",
        scale.subjects, scale.bootstrap == ScaleBootstrap::None ? "" : "; the bootstrap draws observers"));
  if (scale.fit.devianceP)
    out.push_back(fmt::format("goodness of fit: deviance {:.2f} with {} degrees of freedom, p = {}",
                              scale.fit.deviance, scale.fit.df, pText(scale.fit.devianceP)));
  if (scale.firstChosen)
    out.push_back(fmt::format("shown first and chosen: {} of {}, {} (95 % {})", scale.firstChosen->successes,
                              scale.firstChosen->trials, percentText(scale.firstChosen->rate),
                              intervalText(scale.firstChosen->wilson, true)));
  return out;
}

}  // namespace

std::string scaleMethods(const StudyPage& page) {
  std::string out;
  for (const PartScale& part : page.scales) {
    if (!part.scale) continue;
    const BootstrapSetting& bootstrap = part.setting.bootstrap;
    out += fmt::format(
        "Items compared in pairs{} were scaled by the model of Bradley and Terry (1952), by maximum "
        "likelihood with Limen {} and with values that sum to 0, from judgements pooled over observers; ",
        page.scales.size() > 1 ? ", part " + part.part : "", projectVersion());
    out += part.scale->bootstrap == ScaleBootstrap::None
               ? std::string("95 % intervals are values ± 1.96 standard errors")
               : fmt::format(
                     "95 % intervals are from standard errors and percentiles of a bootstrap over "
                     "observers ({} samples, seed {})",
                     bootstrap.samples, bootstrap.seed);
    out += part.scale->steps.size() > 1 ? "; neighbours were compared by z tests, p corrected after Holm. "
                                        : "; the two items were compared by a z test. ";
  }
  return out;
}

void addScales(const StudyPage& page, PageWriter& out) {
  if (page.scales.empty()) return;
  out.openSection("scales", "Comparisons in pairs");
  std::vector<Section> sections;
  for (const PartScale& part : page.scales) {
    if (page.scales.size() > 1) out.heading("Part " + part.part);
    if (!part.scale) {
      out.paragraph("Part " + part.part + " has no scale: " + part.note + ".");
      continue;
    }
    addScaleFigure(page, part, out);
    sections.push_back(sectionOf(*part.scale, part.setting));
    sections.back().fact(key(text("part")), part.part);
    out.table(sections.back().table("items"),
              fmt::format(
                  "Items of part {}: values on Bradley and Terry's scale, which sum to 0; 1 apart, {} prefer "
                  "the upper. Intervals: value ± z standard errors, and of the bootstrap.",
                  part.part, percentText(predictPreference(part.setting.model, 1.0))),
              kScaleFile);
    out.table(sections.back().table("steps"),
              "Neighbours on the scale of part " + part.part +
                  ": differences with 95 % intervals from standard errors, p of no difference.",
              kScaleFile);
    out.table(sections.back().table("consistency"),
              "Circular triads of each observer of part " + part.part + ".", kScaleFile);
    out.list(remarksOnScale(page.study.plan.part(part.part), *part.scale));
  }
  if (!sections.empty()) out.file(kScaleFile, toCsv(sections), "scale values of items compared in pairs");
  out.closeSection();
}

}  // namespace limen::analysis
