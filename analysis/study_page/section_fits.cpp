// SPDX-License-Identifier: BSD-3-Clause
// Psychometric functions of parts with a numeric variable.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/answer_fits/fit_chart.h"
#include "analysis/output/result_renderers.h"
#include "analysis/output/text_output.h"
#include "analysis/study_page/sections.h"
#include "experiments/base/build_facts.h"
#include "experiments/base/gnuplot.h"
#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

constexpr size_t kOpenParameters = 60;
constexpr const char* kFitFile = "tables/psychometric.csv";

std::string intervalText(const FitAnswer& answer) {
  return answer.intervals && answer.intervals->method == IntervalMethod::Observers
             ? "over observers (jackknife, Student's t)"
             : "profile likelihood";
}

void addTables(const FitAnswer& answer, const Section& section, PageWriter& out) {
  const FitSettings& settings = answer.fit.settings;
  ResultTable parameters = section.table("parameters");
  for (Column& column : parameters.columns) column.digits = std::min(column.digits, 4);
  out.table(
      parameters,
      fmt::format(
          "Psychometric functions of {}, part {}: threshold at F = {:.3g}, width from F = 0.05 to 0.95{}, "
          "slope dF/dx at the threshold; 95 % intervals: {}. At bound: of the fit, the data set no "
          "limit on that side.",
          answer.title, answer.part, settings.thresholdLevel,
          settings.logarithmic() ? " in units of ln x" : "", intervalText(answer)),
      kFitFile, kOpenParameters);
  out.table(section.table("conditions"), "Trials and goodness of the fits of part " + answer.part + ".",
            kFitFile);
  out.list(remarksOn(answer));
}

double percentOf(double share) { return 100.0 * std::clamp(share, 0.0, 1.0); }

/// seriesLook() with a size from the data.
std::string sizedLook(size_t number) {
  std::string out = seriesLook(number);
  replaceAll(out, "ps 0.8", "ps variable");
  return out;
}

void addSeries(const FitSeries& series, size_t number, const std::string& size, Figure& figure) {
  const std::string name = series.name.empty() ? "all" : series.name;
  std::vector<std::vector<double>> full, open, curve;
  for (const FitPoint& point : series.points)
    (point.blank ? open : full)
        .push_back({point.level, percentOf(point.share), static_cast<double>(point.trials)});
  for (const auto& [x, share] : series.curve) curve.push_back({x, percentOf(share)});
  figure.plots.push_back(addBlock(figure, name + ": level, fitted in %", curve) + " using 1:2 with lines " +
                         (series.name.empty() ? "notitle" : "title " + gnuplotQuoted(series.name)) + " " +
                         seriesLook(number));
  if (!full.empty())
    figure.plots.push_back(addBlock(figure, name + ": level, answers in %, trials", full) +
                           fmt::format(" using 1:2:({}) with points notitle ", size) + sizedLook(number));
  if (!open.empty())
    figure.plots.push_back(addBlock(figure, name + ": edge, answers without a stimulus in %, trials", open) +
                           fmt::format(" using 1:2:({}) with points notitle pt 6 ps variable ", size) +
                           seriesColour(number));
  figure.plots.push_back(addBlock(figure, name + ": threshold, fitted in %, interval from, to",
                                  {{series.threshold, percentOf(series.thresholdShare), series.interval.low,
                                    series.interval.high}}) +
                         " using 1:2:3:4 with xerrorbars notitle pt 2 ps 0.7 lw 1.2 " + seriesColour(number));
}

std::string trialsText(const FitChart& chart) {
  int64_t least = std::numeric_limits<int64_t>::max(), most = 0;
  for (const FitSeries& series : chart.series)
    for (const FitPoint& point : series.points)
      least = std::min(least, point.trials), most = std::max(most, point.trials);
  return least >= most ? std::to_string(most) : fmt::format("{} to {}", least, most);
}

bool isDrawable(const FitSeries& series) {
  return std::isfinite(series.threshold) && std::isfinite(series.thresholdShare) &&
         std::isfinite(series.interval.low) && std::isfinite(series.interval.high) &&
         std::all_of(series.curve.begin(), series.curve.end(), [](const std::array<double, 2>& place) {
           return std::isfinite(place[0]) && std::isfinite(place[1]);
         });
}

void addFitFigure(const StudyPage& page, const StudyPart& part, const FitAnswer& answer, PageWriter& out) {
  FitChart chart = chartOf(answer);
  for (size_t c = 0; c < chart.series.size() && c < answer.levels.size(); ++c)
    if (const std::string title = conditionTitle(part, answer.levels[c]); !title.empty())
      chart.series[c].name = title;
  Figure figure;
  figure.name = "psychometric_" + page.stem(part.name);
  figure.xTitle = answer.title;
  figure.yTitle = part.asksYesNo() ? "reported a change (%)" : "right answers (%)";
  figure.description =
      figure.yTitle + " against " + answer.title + " with fitted functions, part " + part.name;
  figure.heightPx += static_cast<int>(chart.series.size()) * 18;
  figure.key = chart.series.size() > 1;
  figure.settings = fmt::format("set xrange [{}:{}]\nset yrange [0:102]\nset ytics 20\n",
                                shortestNumber(chart.low), shortestNumber(chart.high)) +
                    (chart.logarithmic ? "set logscale x\n" + chart.xTics : "");
  size_t number = 0;
  for (const FitSeries& series : chart.series) {
    if (isDrawable(series)) addSeries(series, number, pointSize(chart), figure);
    ++number;
  }
  if (figure.plots.empty()) return;
  out.figure(figure,
             fmt::format("Part {}: answers and fitted psychometric functions of {}. The area of points "
                         "is by their trials, {}. Bars: thresholds with 95 % intervals, {}.{}",
                         part.name, answer.title, trialsText(chart), intervalText(answer),
                         chart.blanks ? " Open points at the edge: trials without a stimulus." : ""));
}

std::string sigmoidText(const FitSettings& settings) {
  std::string out = psychometrics::nameOf(settings.sigmoid);
  std::replace(out.begin(), out.end(), '_', ' ');
  for (const auto& [plain, proper] :
       {std::pair{"weibull", "Weibull"}, {"gumbel", "Gumbel"}, {"student t", "Student's t"}})
    replaceAll(out, plain, proper);
  return out;
}

/// How guess and lapse rates came about.
std::string ratesText(const FitSettings& settings) {
  const auto fixed = [&](FitParameter parameter) { return settings.fixed[indexOf(parameter)]; };
  std::string out;
  if (settings.task.kind == FitTask::Kind::ForcedChoice)
    out = fmt::format("guess rate 1/{}", settings.task.alternatives);
  else if (const auto guess = fixed(FitParameter::Guess))
    out = "guess rate " + shortestNumber(*guess);
  else
    out = "guess rate fitted up to " + shortestNumber(settings.guessMost);
  const auto lapse = fixed(FitParameter::Lapse);
  return out + (lapse ? ", lapse rate " + shortestNumber(*lapse)
                      : ", lapse rate fitted up to " + shortestNumber(settings.lapseMost));
}

}  // namespace

std::string fitMethods(const StudyPage& page) {
  std::string out;
  for (const PartFit& part : page.fits) {
    if (!part.answer) continue;
    const FitSettings& settings = part.answer->fit.settings;
    out += fmt::format(
        "Psychometric functions P = guess + (1 - guess - lapse) F of {}{} ({} F, {} on a {} axis; {}) were "
        "fitted by {} with Limen {} to answers pooled over observers; thresholds are at F = {:.3g}, widths "
        "from "
        "0.05 to 0.95, 95 % intervals are those {}. ",
        part.answer->title, page.fits.size() > 1 ? ", part " + part.part : "", sigmoidText(settings),
        settings.falling ? "falling" : "rising", settings.logarithmic() ? "logarithmic" : "linear",
        ratesText(settings),
        settings.method == FitMethod::MaximumLikelihood ? "maximum likelihood" : "maximum a posteriori",
        projectVersion(), settings.thresholdLevel,
        part.answer->intervals && part.answer->intervals->method == IntervalMethod::Observers
            ? "of a jackknife over observers with Student's t (Efron and Stein 1981)"
            : "of the profile likelihood");
  }
  return out;
}

void addFits(const StudyPage& page, PageWriter& out) {
  if (page.fits.empty()) return;
  out.openSection("psychometric", "Psychometric functions");
  std::vector<Section> sections;
  for (const PartFit& part : page.fits) {
    if (page.fits.size() > 1) out.heading("Part " + part.part);
    if (!part.answer) {
      out.paragraph("Part " + part.part + " was not fitted: " + part.note + ".");
      continue;
    }
    addFitFigure(page, page.study.plan.part(part.part), *part.answer, out);
    sections.push_back(sectionOf(*part.answer));
    addTables(*part.answer, sections.back(), out);
  }
  if (!sections.empty()) out.file(kFitFile, toCsv(sections), "parameters of the psychometric functions");
  out.closeSection();
}

}  // namespace limen::analysis
