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

/// 1, 2, 5, 10, ... where powers of ten alone would be one label or none.
std::string logTics(double low, double high) {
  if (high / low > 1000.0) return {};
  std::string list;
  for (double power = std::pow(10.0, std::floor(std::log10(low))); power <= high; power *= 10.0)
    for (const double step : {1.0, 2.0, 5.0})
      if (step * power >= low && step * power <= high)
        list += fmt::format("{}{:.6g}", list.empty() ? "" : ", ", step * power);
  return list.empty() ? std::string() : "set xtics (" + list + ")\n";
}

bool isBlank(const Block& block, const FitSettings& settings) {
  return block.level == kNoStimulus || (settings.logarithmic() && block.level == 0.0);
}

/// Three data blocks a condition: answers, curve, threshold.
std::string dataOf(const FitAnswer& answer, double low, double high) {
  const FitSettings& settings = answer.fit.settings;
  std::string out;
  for (size_t c = 0; c < answer.data.size(); ++c) {
    const ConditionFit& fit = answer.fit.conditions[c];
    out += "# level, share of correct answers, trials, kind of point: full, or open without a stimulus\n";
    for (const Block& block : answer.data[c].blocks) {
      if (block.trials == 0) continue;
      // Without a stimulus: at the edge that F is 0 towards.
      const bool blank = isBlank(block, settings);
      out += fmt::format("{} {} {} {}\n", blank ? (settings.falling ? high : low) : block.level,
                         static_cast<double>(block.correct) / static_cast<double>(block.trials), block.trials,
                         blank ? 6 : 7);
    }
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
  bool blanks = false;
  for (size_t c = 0; c < answer.data.size(); ++c) {
    const auto take = [&](double x) {
      low = std::min(low, x);
      high = std::max(high, x);
    };
    for (const Block& block : answer.data[c].blocks) {
      if (isBlank(block, settings))
        blanks = true;
      else
        take(block.level);
    }
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
                    "\nset encoding utf8\nset border 3\nset tics nomirror out\nset key left " +
                    (settings.falling ? "bottom" : "top") +
                    " Left reverse noenhanced samplen 2\nset xlabel " +
                    gnuplotQuoted(answer.level + (blanks ? " (open points: no stimulus)" : "")) +
                    " noenhanced\nset ylabel 'share of correct or positive answers' noenhanced\n"
                    "set yrange [0:1.02]\n" +
                    fmt::format("set xrange [{}:{}]\n", low, high) +
                    (settings.logarithmic() ? "set logscale x\n" + logTics(low, high) : "") + "plot ";
  const std::string data = gnuplotQuoted(stem + ".dat");
  for (size_t c = 0; c < answer.data.size(); ++c) {
    const char* colour = kChartColours[c % kChartColours.size()];
    const std::string name = answer.data[c].name;
    out += fmt::format("{}{} index {} using 1:2:4 with points pt variable ps 0.7 lc rgb '{}' notitle, ",
                       c ? ", " : "", data, 3 * c, colour);
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
