// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/answer_fits/fit_chart.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "analysis/output/chart_file.h"
#include "experiments/base/gnuplot.h"

namespace limen::analysis {

namespace {

constexpr int kCurveSteps = 200;

bool isBlank(const Block& block, const FitSettings& settings) {
  return block.level == kNoStimulus || (settings.logarithmic() && block.level == 0.0);
}

void setEdges(const FitAnswer& answer, FitChart& chart) {
  double low = INFINITY, high = -INFINITY;
  const auto take = [&](double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  };
  for (size_t c = 0; c < answer.data.size(); ++c) {
    for (const Block& block : answer.data[c].blocks) {
      if (isBlank(block, answer.fit.settings))
        chart.blanks = true;
      else
        take(block.level);
    }
    take(answer.fit.conditions[c].value(FitParameter::Threshold));
  }
  if (chart.logarithmic) {
    const double margin = low < high ? std::pow(high / low, 0.05) : 2.0;
    chart.low = low / margin;
    chart.high = high * margin;
    chart.xTics = logarithmicTics(chart.low, chart.high);
  } else {
    const double margin = low < high ? 0.05 * (high - low) : std::max(1.0, std::abs(low));
    chart.low = low - margin;
    chart.high = high + margin;
  }
}

FitSeries seriesOf(const FitAnswer& answer, size_t c, const FitChart& chart) {
  const FitSettings& settings = answer.fit.settings;
  const ConditionFit& fit = answer.fit.conditions[c];
  FitSeries out;
  out.name = answer.data[c].name;
  for (const Block& block : answer.data[c].blocks) {
    if (block.trials == 0) continue;
    const bool blank = isBlank(block, settings);
    out.points.push_back({blank ? (chart.falling ? chart.high : chart.low) : block.level,
                          static_cast<double>(block.correct) / static_cast<double>(block.trials),
                          block.trials, blank});
  }
  for (int i = 0; i <= kCurveSteps; ++i) {
    const double part = static_cast<double>(i) / kCurveSteps;
    const double x = chart.logarithmic ? chart.low * std::pow(chart.high / chart.low, part)
                                       : chart.low + (chart.high - chart.low) * part;
    out.curve.push_back({x, fit.probability(settings, x)});
  }
  const double guess = fit.value(FitParameter::Guess), lapse = fit.value(FitParameter::Lapse);
  out.threshold = fit.value(FitParameter::Threshold);
  out.thresholdShare = guess + (1.0 - guess - lapse) * settings.thresholdLevel;
  out.interval = {{out.threshold, out.threshold}};
  if (answer.intervals) out.interval = answer.intervals->conditions[c][0].value_or(out.interval);
  return out;
}

/// Three data blocks a condition: answers, curve, threshold.
std::string dataOf(const FitChart& chart) {
  std::string out;
  for (const FitSeries& series : chart.series) {
    out += "# level, share of correct answers, trials, kind of point: full, or open without a stimulus\n";
    for (const FitPoint& point : series.points)
      out += fmt::format("{} {} {} {}\n", point.level, point.share, point.trials, point.blank ? 6 : 7);
    out += "\n\n# level, fitted\n";
    for (const auto& [x, share] : series.curve) out += fmt::format("{} {}\n", x, share);
    out += fmt::format("\n\n# threshold, its P, interval\n{} {} {} {}\n\n\n", series.threshold,
                       series.thresholdShare, series.interval.low, series.interval.high);
  }
  return out;
}

}  // namespace

FitChart chartOf(const FitAnswer& answer) {
  FitChart out;
  out.logarithmic = answer.fit.settings.logarithmic();
  out.falling = answer.fit.settings.falling;
  setEdges(answer, out);
  for (size_t c = 0; c < answer.data.size(); ++c) out.series.push_back(seriesOf(answer, c, out));
  return out;
}

std::string pointSize(const FitChart& chart) {
  int64_t most = 1;
  for (const FitSeries& series : chart.series)
    for (const FitPoint& point : series.points) most = std::max(most, point.trials);
  return fmt::format("0.3+0.9*sqrt($3/{}.0)", most);
}

void drawFit(const FitAnswer& answer, const std::string& path) {
  const ChartFile file(path);
  const FitChart chart = chartOf(answer);
  std::string out = file.head() + "set key left " + (chart.falling ? "bottom" : "top") +
                    " Left reverse noenhanced samplen 2\nset xlabel " +
                    gnuplotQuoted((answer.title.empty() ? answer.level : answer.title) +
                                  (chart.blanks ? " (open points: no stimulus)" : "")) +
                    " noenhanced\nset ylabel 'share of correct or positive answers' noenhanced\n"
                    "set yrange [0:1.02]\n" +
                    fmt::format("set xrange [{}:{}]\n", chart.low, chart.high) +
                    (chart.logarithmic ? "set logscale x\n" + chart.xTics : "") + "plot ";
  for (size_t c = 0; c < chart.series.size(); ++c) {
    const std::string& name = chart.series[c].name;
    out += fmt::format(
        "{0}{1} index {2} using 1:2:({7}):4 with points ps variable pt variable {5} notitle, {1} index {3} "
        "using 1:2 "
        "with lines "
        "lw 1.5 {5} {6}, {1} index {4} using 1:2:3:4 with xerrorbars pt 2 ps 0.7 {5} notitle",
        c ? ", " : "", file.data(), 3 * c, 3 * c + 1, 3 * c + 2, seriesStyle(c),
        name.empty() ? "notitle" : "title " + gnuplotQuoted(name), pointSize(chart));
  }
  file.draw(out + "\n", dataOf(chart));
}

}  // namespace limen::analysis
