// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <filesystem>

#include "analysis/answer_fits/fit_chart.h"
#include "experiments/base/error.h"
#include "experiments/base/gnuplot.h"

namespace limen::analysis {
namespace {

namespace fs = std::filesystem;

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

void drawFit(const FitAnswer& answer, const std::string& path) {
  const fs::path file(path);
  const std::string extension = file.extension().string();
  if (extension != ".svg" && extension != ".pdf" && extension != ".png")
    throw Error("no picture of the kind '" + extension + "' is drawn", path,
                "let the name end in .svg, .pdf or .png");
  const FitChart chart = chartOf(answer);
  const std::string stem = file.stem().string();
  std::string out = "# Draws " + file.filename().string() + " from " + stem + ".dat.\nreset\nset terminal " +
                    gnuplotTerminal(extension) + "\nset output " + gnuplotQuoted(file.filename().string()) +
                    "\nset encoding utf8\nset border 3\nset tics nomirror out\nset key left " +
                    (chart.falling ? "bottom" : "top") + " Left reverse noenhanced samplen 2\nset xlabel " +
                    gnuplotQuoted(answer.level + (chart.blanks ? " (open points: no stimulus)" : "")) +
                    " noenhanced\nset ylabel 'share of correct or positive answers' noenhanced\n"
                    "set yrange [0:1.02]\n" +
                    fmt::format("set xrange [{}:{}]\n", chart.low, chart.high) +
                    (chart.logarithmic ? "set logscale x\n" + chart.xTics : "") + "plot ";
  const std::string data = gnuplotQuoted(stem + ".dat");
  for (size_t c = 0; c < chart.series.size(); ++c) {
    const char* colour = kChartColours[c % kChartColours.size()];
    const std::string name = chart.series[c].name;
    out += fmt::format("{}{} index {} using 1:2:4 with points pt variable ps 0.7 lc rgb '{}' notitle, ",
                       c ? ", " : "", data, 3 * c, colour);
    out += fmt::format("{} index {} using 1:2 with lines lw 1.5 lc rgb '{}' {}, ", data, 3 * c + 1, colour,
                       name.empty() ? "notitle" : "title " + gnuplotQuoted(name));
    out += fmt::format("{} index {} using 1:2:3:4 with xerrorbars pt 2 ps 0.7 lc rgb '{}' notitle", data,
                       3 * c + 2, colour);
  }
  drawPicture(path, out + "\n", dataOf(chart));
}

}  // namespace limen::analysis
