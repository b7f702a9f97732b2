// SPDX-License-Identifier: BSD-3-Clause
// Signal detection: d' and criterion of each observer and their means.
#include <fmt/format.h>

#include <algorithm>

#include "analysis/output/result_renderers.h"
#include "analysis/output/text_output.h"
#include "analysis/study_page/sections.h"
#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

constexpr size_t kMostNames = 45;  // beyond, observers have no room for their codes
constexpr size_t kOpenSensitivityRows = 20;
constexpr const char* kSensitivityFile = "tables/sensitivity.csv";

struct Dot {
  std::string observer;
  double value = 0.0, low = 0.0, high = 0.0;
};

/// Observers by their value, with the mean over them and its interval as lines.
Figure dotFigure(const std::string& name, const std::string& yTitle, std::vector<Dot> dots,
                 const MeanOverSubjects& mean) {
  std::stable_sort(dots.begin(), dots.end(), [](const Dot& a, const Dot& b) { return a.value < b.value; });
  Figure figure;
  figure.name = name;
  figure.key = false;
  figure.xTitle = "observer";
  figure.yTitle = yTitle;
  figure.description = yTitle + " of each observer, from the least to the largest";
  std::vector<std::vector<double>> rows;
  std::vector<std::pair<double, std::string>> labels;
  for (size_t i = 0; i < dots.size(); ++i) {
    const auto place = static_cast<double>(i + 1);
    rows.push_back({place, dots[i].value, dots[i].low, dots[i].high});
    if (dots.size() <= kMostNames) labels.emplace_back(place, dots[i].observer);
  }
  const double end = static_cast<double>(dots.size()) + 0.5;
  figure.settings = (labels.empty() ? "unset xtics\n" : namedTics("x", labels)) +
                    fmt::format("set xrange [0.5:{}]\n", shortestNumber(end));
  if (!labels.empty()) {
    const bool dense = dots.size() > 8;
    if (dense)
      figure.settings += fmt::format("set xtics rotate by 90 right font ',{}'\n", dots.size() > 24 ? 6 : 8);
    if (dense) figure.heightPx += 30;
  }
  if (mean.interval) {
    const std::string band = addBlock(
        figure, "interval of the mean: place, low, high",
        {{0.5, mean.interval->low, mean.interval->high}, {end, mean.interval->low, mean.interval->high}});
    figure.plots.push_back(
        band + " using 1:2:3 with filledcurves fc rgb '#0072B2' fs transparent solid 0.12 noborder");
  }
  figure.plots.push_back(addBlock(figure, "mean over observers", {{0.5, mean.mean}, {end, mean.mean}}) +
                         " using 1:2 with lines lw 1.5 " + seriesColour(0));
  const std::string block = addBlock(figure, "place, value, interval from, to", rows);
  figure.plots.push_back(block + " using 1:2:3:4 with yerrorbars pt 0 lw 1.2 lc rgb '#444444'");
  figure.plots.push_back(block + " using 1:2 with points pt 7 ps 0.7 lc rgb '#444444'");
  return figure;
}

std::string rankNote(size_t observers) {
  return observers > kMostNames ? " Too many observers for their codes: the table has them." : "";
}

void addFigures(const StudyPage& page, const PartSensitivity& part, PageWriter& out) {
  std::vector<Dot> dPrimes, criteria;
  for (const SensitivityRow& row : part.rows) {
    if (row.observer.empty()) continue;
    if (row.yesNo) {
      dPrimes.push_back(
          {row.observer, row.yesNo->dPrime, row.yesNo->dPrimeInterval.low, row.yesNo->dPrimeInterval.high});
      criteria.push_back({row.observer, row.yesNo->criterion, row.yesNo->criterionInterval.low,
                          row.yesNo->criterionInterval.high});
    }
    if (row.mAfc)
      dPrimes.push_back({row.observer, row.mAfc->dPrime, row.mAfc->low.value_or(row.mAfc->dPrime),
                         row.mAfc->high.value_or(row.mAfc->dPrime)});
  }
  const std::string stem = page.stem(part.part);
  out.html("<div class=\"figures pair\">\n");
  if (!dPrimes.empty() && part.dPrime) {
    const std::string how =
        part.yesNo ? "bars are 95 % intervals after Gourevitch and Galanter"
                   : "bars are 95 % intervals from Wilson's of the share of right answers, sides "
                     "without bound left out";
    out.figure(
        dotFigure("d_prime_" + stem, "sensitivity d′", dPrimes, *part.dPrime),
        fmt::format("Part {}: sensitivity d′ of each observer, sorted; {}. Line and band: mean over {} "
                    "and its 95 % t interval.{}",
                    part.part, how, counted(dPrimes.size(), "observer"), rankNote(dPrimes.size())));
  }
  if (!criteria.empty() && part.criterion)
    out.figure(
        dotFigure("criterion_" + stem, "criterion c", criteria, *part.criterion),
        fmt::format(
            "Part {}: criterion c of each observer, sorted, as above. Above 0: reluctant to say yes.{}",
            part.part, rankNote(criteria.size())));
  out.html("</div>\n");
}

}  // namespace

void addSensitivity(const StudyPage& page, PageWriter& out) {
  if (std::none_of(page.sensitivity.begin(), page.sensitivity.end(),
                   [](const PartSensitivity& part) { return part.dPrime.has_value(); }))
    return;
  out.openSection("sensitivity", "Signal detection");
  for (const PartSensitivity& part : page.sensitivity) {
    if (page.sensitivity.size() > 1) out.heading("Part " + part.part);
    if (!part.note.empty()) out.paragraph("Mind: " + part.note + ".");
    if (part.rows.empty()) continue;
    addFigures(page, part, out);
    const Section section = sectionOf(part);
    out.table(section.table("means"), "Means over observers, part " + part.part + ", with 95 % t intervals.",
              kSensitivityFile);
    out.table(section.table("rows"),
              "Observers of part " + part.part +
                  (part.yesNo ? ": d′, criterion c, ln β, β and A′, each with its 95 % interval."
                              : ": correct answers and d′ with its 95 % interval."),
              kSensitivityFile, kOpenSensitivityRows);
  }
  out.paragraph(
      "Equal-variance Gaussian model; rates are corrected by (k + 1/2) of (n + 1). Taken over all answers "
      "together d′ "
      "comes out too small where observers differ: the mean over observers is the one to report.");
  out.file(kSensitivityFile, toCsv(resultOf(page.sensitivity).sections),
           "sensitivity and criterion of each observer");
  out.closeSection();
}

}  // namespace limen::analysis
