// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of each observer, which are the result of adaptive procedures, and what conditions do to them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/output/chart_file.h"
#include "analysis/output/result_renderers.h"
#include "analysis/output/text_output.h"
#include "analysis/study_page/sections.h"
#include "experiments/base/gnuplot.h"

namespace limen::analysis {
namespace {

constexpr const char* kFile = "tables/thresholds.csv";
constexpr const char* kOfObserver = "lc rgb '#aaaaaa' lw 0.7 pt 7 ps 0.35";

constexpr const char* kWithin = "lc rgb '#9cc9e8'";

/// Conditions side by side; each observer a grey line, means with intervals over observers in front.
std::optional<Figure> thresholdFigure(const StudyPage& page, const PartThresholds& part) {
  const StudyPart& plan = page.study.plan.part(part.part);
  Figure figure;
  figure.name = "thresholds_" + page.stem(part.part);
  figure.yTitle = "threshold of " + part.title;
  figure.description = "thresholds of " + part.title + " by condition, part " + part.part;
  std::vector<std::pair<double, std::string>> labels;
  size_t longest = 0;
  for (const ThresholdCondition& one : part.conditions) {
    std::string label = conditionTitle(plan, one.levels);
    if (label.empty()) label = "all";
    longest = std::max(longest, label.size());
    labels.emplace_back(static_cast<double>(labels.size() + 1), label);
  }
  const bool turned = longest * labels.size() > 44;
  figure.heightPx += 60;
  if (turned) figure.heightPx += 40 + static_cast<int>(std::min<size_t>(longest, 24)) * 5;
  double low = INFINITY, high = -INFINITY;
  const auto take = [&](double value) { low = std::min(low, value), high = std::max(high, value); };
  std::vector<std::vector<double>> rows;
  for (size_t c = 0; c < part.conditions.size(); ++c) {
    const ThresholdCondition& one = part.conditions[c];
    if (!one.mean) continue;
    const Interval interval = one.interval.value_or(Interval{*one.mean, *one.mean});
    const Interval within = one.within.value_or(Interval{*one.mean, *one.mean});
    rows.push_back(
        {static_cast<double>(c + 1), *one.mean, interval.low, interval.high, within.low, within.high});
    take(*one.mean);
  }
  if (rows.empty()) return {};
  for (size_t observer = 0; observer < page.study.observers.size(); ++observer) {
    std::vector<std::vector<double>> own;
    for (const ObserverThreshold& one : part.observers)
      if (one.observer == observer && one.value) {
        own.push_back({static_cast<double>(one.condition + 1), *one.value});
        take(*one.value);
      }
    if (own.empty()) continue;
    const bool first = figure.plots.empty();
    figure.plots.push_back(addBlock(figure, "observer: condition, threshold", own) +
                           " using 1:2 with linespoints " + (first ? "title 'each observer' " : "notitle ") +
                           kOfObserver);
  }
  const std::string means =
      addBlock(figure, "over observers: condition, mean, interval from, to, within observers from, to", rows);
  if (std::any_of(part.conditions.begin(), part.conditions.end(),
                  [](const ThresholdCondition& one) { return one.within.has_value(); }))
    figure.plots.push_back(means + " using 1:5:(0):($6-$5) with vectors nohead lw 5 " + kWithin +
                           " title '95 % within observers'");
  figure.plots.push_back(means + " using 1:3:(0):($4-$3) with vectors nohead lw 1.5 " + seriesColour(0) +
                         " title '95 % over observers'");
  figure.plots.push_back(means + " using 1:2 with points pt 7 ps 0.8 " + seriesColour(0) + " title 'mean'");
  // Intervals of few observers may be far wider than all that was measured.
  for (const std::vector<double>& row : rows)
    for (const double end : {row[2], row[3]})
      if (end > (part.logarithmic() ? low / 3.0 : low - (high - low)) &&
          end < (part.logarithmic() ? high * 3.0 : high + (high - low)))
        take(end);
  const double margin = part.logarithmic() ? std::pow(high / low, 0.06) : 0.06 * (high - low);
  if (part.logarithmic()) {
    const double bottom = low / std::max(margin, 1.02), top = high * std::max(margin, 1.02);
    std::string tics = logarithmicTics(bottom, top);
    replaceAll(tics, "xtics", "ytics");
    figure.settings += fmt::format("set logscale y\nset yrange [{}:{}]\n", bottom, top) + tics;
  } else if (high > low) {
    figure.settings += fmt::format("set yrange [{}:{}]\n", low - margin, high + margin);
  }
  figure.settings += "set clip two\n" + namedTics("x", labels, turned) +
                     fmt::format("set xrange [0.5:{}.5]\n", labels.size());
  return figure;
}

void addPart(const StudyPage& page, const PartThresholds& part, const Section& section, PageWriter& out) {
  if (!part.note.empty()) {
    out.paragraph("Part " + part.part + " has no thresholds: " + part.note + ".");
    return;
  }
  if (auto figure = thresholdFigure(page, part))
    out.figure(
        std::move(*figure),
        fmt::format("Part {}: thresholds of {} of {}. Dark: {} with 95 % t intervals over observers; light: "
                    "within observers (Cousineau-Morey), for comparing conditions. Intervals that "
                    "leave the picture are in the table.",
                    part.part, part.title, counted(page.study.observers.size(), "observer"),
                    part.logarithmic() ? "geometric means" : "means"));
  out.table(
      section.table("conditions"),
      fmt::format("Thresholds of {} in part {} over observers (F = {:.3g}): {} of their own thresholds.",
                  part.title, part.part, part.settings.thresholdLevel,
                  part.logarithmic() ? "geometric means" : "means"),
      kFile);
  for (const ResultTable& table : section.tables)
    if (table.name == "effects" || table.name == "pairs")
      out.table(table,
                table.name == "effects" ? "Repeated-measures analysis of variance of each observer's " +
                                              part.anova->measure + ", part " + part.part + "."
                                        : "Part " + part.part + ", " + table.title +
                                              "; p with Holm's correction over the pairs of a factor.",
                kFile);
  out.table(
      section.table("thresholds"),
      fmt::format("Thresholds of each observer in part {}, fitted to the observer's own answers{}.",
                  part.part, part.procedure.empty() ? "" : ", and as " + part.procedure + " estimated them"),
      kFile, 12);
  out.list(section.notes);
}

}  // namespace

std::string thresholdMethods(const StudyPage& page) {
  for (const PartThresholds& part : page.thresholds)
    if (part.note.empty())
      return "Thresholds are those of psychometric functions fitted by maximum likelihood to each observer's "
             "own "
             "answers, whose conditions share one width, one lapse rate and, in yes/no tasks, one guess "
             "rate. Means "
             "over observers, geometric on logarithmic axes, have 95 % intervals from Student's t, and "
             "within "
             "observers after Cousineau and Morey (Morey 2008); conditions were compared by "
             "repeated-measures "
             "analysis of variance of each observer's thresholds, of their logarithms on logarithmic axes, "
             "and by "
             "paired t tests, p corrected after Holm over the pairs of a factor. ";
  return "";
}

void addThresholds(const StudyPage& page, PageWriter& out) {
  if (page.thresholds.empty()) return;
  out.openSection("thresholds", "Thresholds");
  const Result result = resultOf(page.thresholds, page.study);
  for (size_t i = 0; i < page.thresholds.size(); ++i) {
    if (page.thresholds.size() > 1) out.heading("Part " + page.thresholds[i].part);
    addPart(page, page.thresholds[i], result.sections[i], out);
  }
  out.file(kFile, toCsv(result.sections), "thresholds of each observer and condition, and their tests");
  out.closeSection();
}

}  // namespace limen::analysis
