// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "analysis/fits/fit_answer.h"
#include "analysis/output/text_output.h"
#include "base/error.h"
#include "base/gnuplot.h"

namespace limen::analysis {
namespace {

namespace fs = std::filesystem;

/// Three data blocks a condition: answers, curve, threshold.
std::string dataOf(const FitAnswer& answer, double low, double high) {
  const FitSettings& settings = answer.fit.settings;
  std::string out;
  for (size_t c = 0; c < answer.data.size(); ++c) {
    const ConditionFit& fit = answer.fit.conditions[c];
    out += "# level, share of correct answers, trials\n";
    for (const Block& block : answer.data[c].blocks)
      if (block.trials > 0 && (!settings.logarithmic() || block.level > 0.0))
        out +=
            fmt::format("{} {} {}\n", block.level,
                        static_cast<double>(block.correct) / static_cast<double>(block.trials), block.trials);
    out += "\n\n# level, fitted\n";
    for (int i = 0; i <= 200; ++i) {
      const double part = i / 200.0;
      const double x = settings.logarithmic() ? low * std::pow(high / low, part) : low + (high - low) * part;
      out += fmt::format("{} {}\n", x, fit.probability(settings, x));
    }
    const double threshold = fit.value(FitParameter::Threshold);
    const double guess = fit.value(FitParameter::Guess), lapse = fit.value(FitParameter::Lapse);
    FitInterval interval{threshold, threshold, false, false};
    if (answer.intervals) interval = answer.intervals->conditions[c][0].value_or(interval);
    out += fmt::format("\n\n# threshold, its P, interval\n{} {} {} {}\n\n\n", threshold,
                       guess + (1.0 - guess - lapse) * settings.thresholdLevel, interval.low, interval.high);
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
  const FitSettings& settings = answer.fit.settings;
  double low = INFINITY, high = -INFINITY;
  for (size_t c = 0; c < answer.data.size(); ++c) {
    const auto take = [&](double x) {
      if (settings.logarithmic() && x <= 0.0) return;
      low = std::min(low, x);
      high = std::max(high, x);
    };
    for (const Block& block : answer.data[c].blocks) take(block.level);
    take(answer.fit.conditions[c].value(FitParameter::Threshold));
  }
  if (settings.logarithmic()) {
    const double margin = low < high ? std::pow(high / low, 0.05) : 2.0;
    low /= margin;
    high *= margin;
  } else {
    const double margin = low < high ? 0.05 * (high - low) : std::max(1.0, std::abs(low));
    low -= margin;
    high += margin;
  }
  const fs::path folder = file.parent_path().empty() ? fs::path(".") : file.parent_path();
  const std::string stem = file.stem().string();
  std::string out = "# Draws " + file.filename().string() + " from " + stem + ".dat.\nreset\nset terminal " +
                    gnuplotTerminal(extension) + "\nset output " + gnuplotQuoted(file.filename().string()) +
                    "\nset encoding utf8\nset border 3\nset tics nomirror out\nset key left top Left reverse "
                    "noenhanced samplen 2\nset xlabel 'level' noenhanced\nset ylabel 'share of correct or "
                    "positive answers' noenhanced\nset yrange [0:1.02]\n" +
                    fmt::format("set xrange [{}:{}]\n", low, high) +
                    (settings.logarithmic() ? "set logscale x\n" : "") + "plot ";
  const std::string data = gnuplotQuoted(stem + ".dat");
  for (size_t c = 0; c < answer.data.size(); ++c) {
    const char* colour = kChartColours[c % kChartColours.size()];
    const std::string name = answer.data[c].name;
    out += fmt::format("{}{} index {} using 1:2 with points pt 7 ps 0.7 lc rgb '{}' notitle, ", c ? ", " : "",
                       data, 3 * c, colour);
    out += fmt::format("{} index {} using 1:2 with lines lw 1.5 lc rgb '{}' {}, ", data, 3 * c + 1, colour,
                       name.empty() ? "notitle" : "title " + gnuplotQuoted(name));
    out += fmt::format("{} index {} using 1:2:3:4 with xerrorbars pt 2 ps 0.7 lc rgb '{}' notitle", data,
                       3 * c + 2, colour);
  }
  writeFileBytes((folder / (stem + ".dat")).string(), dataOf(answer, low, high));
  writeFileBytes((folder / (stem + ".gp")).string(), out + "\n");
  runGnuplot(folder.string(), stem + ".gp");
}

}  // namespace limen::analysis
