// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>

#include "analysis/output/text_output.h"
#include "analysis/sweep/switch_distances.h"
#include "experiments/base/gnuplot.h"
#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

using Place = Crossing::Place;

nlohmann::json distanceJson(const std::optional<Crossing>& crossing) {
  if (!crossing || crossing->place != Place::Within) return nullptr;
  return crossing->x;
}

/// How an estimate lies to the measured distances, as a word.
const char* boundWord(const Crossing& crossing) {
  return crossing.place == Place::AtOrBelowFirst ? "at_or_below_nearest"
         : crossing.place == Place::BeyondLast   ? "beyond_farthest"
                                                 : "within";
}

std::string distanceText(const std::optional<Crossing>& crossing) {
  if (!crossing) return "-";
  const std::string sign = crossing->place == Place::AtOrBelowFirst ? "<= "
                           : crossing->place == Place::BeyondLast   ? "> "
                                                                    : "";
  return sign + formatNumber(crossing->x);
}

std::string nameOf(const SwitchDistance& one) {
  std::vector<std::string> parts;
  const auto from = one.condition.find("from_level"), to = one.condition.find("to_level");
  const bool pair = from != one.condition.end() && to != one.condition.end();
  if (pair) parts.push_back("level " + from->second + " to " + to->second);
  for (const auto& [name, text] : one.condition)
    if (!pair || (name != "from_level" && name != "to_level")) parts.push_back(name + "=" + text);
  return parts.empty() ? one.technique : join(parts);
}

/// "in a window of 320 x 240 px, display schwarz_2009"; "" if nothing is known.
std::string seenText(const SwitchReport& report) {
  const auto get = [&](const char* name) {
    const auto found = report.seen.find(name);
    return found == report.seen.end() ? std::string() : found->second;
  };
  std::vector<std::string> parts;
  if (!get("width").empty() && !get("height").empty())
    parts.push_back("in a window of " + get("width") + " x " + get("height") + " px");
  const std::string display = get("display_file").empty() ? get("display") : get("display_file");
  if (!display.empty()) parts.push_back("display " + display);
  return join(parts);
}

/// 1, 2 and 5 times powers of ten within a range, as gnuplot takes tics.
std::string logarithmicTics(double low, double high) {
  std::vector<std::string> out;
  for (int decade = static_cast<int>(std::floor(std::log10(low))); std::pow(10.0, decade) <= high; ++decade)
    for (const double step : {1.0, 2.0, 5.0})
      if (const double tic = step * std::pow(10.0, decade); tic >= low && tic <= high)
        out.push_back(shortestNumber(tic));
  return "(" + join(out) + ")";
}

// With more curves the views' ranges hide them; the table has them all the same.
// Colours: distinct on white and for colour-blind readers (Okabe and Ito 2008, without yellow); then dashes
// tell.
constexpr size_t kMostWithBars = 8;
constexpr const char* kColours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                    "#56b4e9", "#e69f00", "#000000"};

std::vector<double> meanOf(const SwitchDistance& one) {
  std::vector<double> out(one.distances.size(), 0.0);
  for (const std::vector<double>& view : one.views)
    for (size_t i = 0; i < out.size(); ++i) out[i] += view[i] / static_cast<double>(one.views.size());
  return out;
}

}  // namespace

std::string toJson(const SwitchReport& report) {
  nlohmann::json out = {{"event", "switch_distances"},
                        {"title", report.title},
                        {"experiment", report.hash},
                        {"probability", report.probability},
                        {"confidence", report.confidence},
                        {"runs_left_out", report.leftOut},
                        {"seen", report.seen},
                        {"switches", nlohmann::json::array()}};
  for (const SwitchDistance& one : report.switches) {
    nlohmann::json curve = nlohmann::json::array();
    const std::vector<double> mean = meanOf(one), fit = fitNonIncreasing(mean);
    for (size_t i = 0; i < mean.size(); ++i)
      curve.push_back({{"distance", one.distances[i]}, {"probability", mean[i]}, {"fit", fit[i]}});
    const CrossingEstimate& estimate = one.estimate;
    out["switches"].push_back({{"technique", one.technique},
                               {"scene", one.scene},
                               {"condition", one.condition},
                               {"distance", distanceJson(estimate.ofMean)},
                               {"bound", boundWord(estimate.ofMean)},
                               {"low", distanceJson(estimate.low)},
                               {"low_bound", estimate.low ? boundWord(*estimate.low) : "none"},
                               {"high", distanceJson(estimate.high)},
                               {"high_bound", estimate.high ? boundWord(*estimate.high) : "none"},
                               {"every_view", distanceJson(estimate.farthest)},
                               {"every_view_bound", boundWord(estimate.farthest)},
                               {"views", one.views.size()},
                               {"curve", std::move(curve)}});
  }
  return out.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string toCsv(const SwitchReport& report) {
  std::string out = csvLine({"technique", "scene", "condition", "views", "distance", "probability_mean",
                             "probability_fit", "probability_lowest", "probability_highest"});
  for (const SwitchDistance& one : report.switches) {
    const std::vector<double> mean = meanOf(one), fit = fitNonIncreasing(mean);
    for (size_t i = 0; i < mean.size(); ++i) {
      double low = 1e300, high = -1e300;
      for (const std::vector<double>& view : one.views) {
        low = std::min(low, view[i]);
        high = std::max(high, view[i]);
      }
      out += csvLine({one.technique, one.scene, nameOf(one), std::to_string(one.views.size()),
                      shortestNumber(one.distances[i]), shortestNumber(mean[i]), shortestNumber(fit[i]),
                      shortestNumber(low), shortestNumber(high)});
    }
  }
  return out;
}

std::string toText(const SwitchReport& report) {
  std::string out =
      fmt::format("{}\nnearest distance at which a switch is seen with a probability of {} at most\n",
                  report.title, shortestNumber(report.probability));
  if (const std::string seen = seenText(report); !seen.empty()) out += seen + "\n";
  size_t width = 6;
  for (const SwitchDistance& one : report.switches) width = std::max(width, nameOf(one).size());
  out += fmt::format("  {:<{}}  {:>10}  {:>22}  {:>10}  {}\n", "switch", width, "distance",
                     fmt::format("{:g} % interval", 100.0 * report.confidence), "every view", "views");
  for (const SwitchDistance& one : report.switches) {
    const CrossingEstimate& estimate = one.estimate;
    const std::string interval =
        estimate.low ? distanceText(estimate.low) + " to " + distanceText(estimate.high) : "one view: none";
    out += fmt::format("  {:<{}}  {:>10}  {:>22}  {:>10}  {:>5}\n", nameOf(one), width,
                       distanceText(estimate.ofMean), interval, distanceText(estimate.farthest),
                       one.views.size());
  }
  out += "  distance: of the mean over views; every view: none is seen more often from there on\n";
  if (report.leftOut > 0)
    out += fmt::format("  {} planned runs are missing or failed and were left out\n", report.leftOut);
  return out;
}

std::string drawSwitchChart(const SwitchReport& report, const std::string& folder) {
  const std::string name = "switch_distances";
  const std::filesystem::path base = std::filesystem::path(folder) / name;
  // Data sets: for each switch the curve of all views together with the views' range, then its crossing. The
  // bars are set a little apart so that those of one distance do not hide one another.
  std::string data, plots;
  size_t index = 0;
  double nearest = 1e300, farthest = 0.0;
  size_t longest = 0;
  for (const SwitchDistance& one : report.switches) {
    nearest = std::min(nearest, one.distances.front());
    farthest = std::max(farthest, one.distances.back());
    longest = std::max(longest, nameOf(one).size());
  }
  const double low = nearest / 1.15, high = farthest * 1.15;
  const bool bars = report.switches.size() <= kMostWithBars;
  const double apart = std::pow(high / low, 0.004);
  for (const SwitchDistance& one : report.switches) {
    const std::vector<double> mean = meanOf(one);
    const double aside =
        std::pow(apart, static_cast<double>(index) - 0.5 * static_cast<double>(report.switches.size() - 1));
    data += "# " + nameOf(one) + ": distance, mean, lowest and highest probability\n";
    for (size_t i = 0; i < mean.size(); ++i) {
      double least = mean[i], most = mean[i];
      for (const std::vector<double>& view : one.views) {
        least = std::min(least, view[i]);
        most = std::max(most, view[i]);
      }
      data += fmt::format("{} {} {} {}\n", shortestNumber(one.distances[i]), shortestNumber(mean[i]),
                          shortestNumber(least), shortestNumber(most));
    }
    const CrossingEstimate& estimate = one.estimate;
    const double from = estimate.low ? estimate.low->x : estimate.ofMean.x;
    const double to = estimate.high ? estimate.high->x : estimate.ofMean.x;
    data += fmt::format(
        "\n\n# where it comes down to the probability: distance, probability, low, high\n{} {} {} {}\n\n\n",
        estimate.ofMean.place == Place::Within ? shortestNumber(estimate.ofMean.x) : "NaN",
        shortestNumber(report.probability), shortestNumber(from), shortestNumber(to));
    if (bars)
      plots += fmt::format(
          "{0}'{1}.dat' index {2} using ($1*{3}):2:3:4 with yerrorbars lc rgb '{4}' ps 0 lw 1 notitle",
          plots.empty() ? "" : ", \\\n  ", name, 2 * index, shortestNumber(aside),
          kColours[index % std::size(kColours)]);
    plots += fmt::format(
        "{0}'{1}.dat' index {2} using 1:2 with linespoints lc rgb '{3}' dt {7} pt {6} ps 0.6 lw 2 title {4}, "
        "\\\n"
        "  '' index {5} using 1:2:3:4 with xerrorbars lc rgb '{3}' pt 7 ps 1.1 lw 2.5 notitle",
        plots.empty() ? "" : ", \\\n  ", name, 2 * index, kColours[index % std::size(kColours)],
        gnuplotQuoted(nameOf(one)), 2 * index + 1, 4 + index % 10, 1 + index / std::size(kColours));
    ++index;
  }
  const size_t columns = std::clamp<size_t>(84 / (longest + 8), 1, 4),
               rows = (report.switches.size() + columns - 1) / columns;
  const std::string seen = seenText(report);
  writeFileBytes(base.string() + ".dat", data);
  writeFileBytes(
      base.string() + ".gp",
      fmt::format(
          "# Draws {0}.svg from {0}.dat. For a paper: gnuplot -e pdf=1 {0}.gp\nreset\n"
          "if (exists('pdf')) {{\n  set terminal pdfcairo size 14cm,{4}cm font 'sans,10'\n"
          "  set output '{0}.pdf'\n}} else {{\n"
          "  set terminal svg size 760,{5} dynamic font 'DejaVu Sans,13' background '#ffffff' noenhanced\n"
          "  set output '{0}.svg'\n}}\n"
          "set encoding utf8\nset border 3\nset tics nomirror out\nset logscale x\n"
          "set xrange [{6}:{7}]\nset xtics {8}\nset mxtics 1\nset rmargin 4\n"
          "set key outside below noenhanced maxcols {9} samplen 3\nset grid lt 1 lw 0.5 lc rgb '#dddddd'\n"
          "set bars 0.5\nset title {1} noenhanced\nset xlabel {10} noenhanced\n"
          "set ylabel {11}\nset yrange [0:1]\n"
          "set arrow from graph 0, first {2} to graph 1, first {2} nohead dt 2 lc rgb '#777777'\n"
          "plot {3}\n",
          name, gnuplotQuoted(report.title), shortestNumber(report.probability), plots,
          shortestNumber(8.5 + 0.5 * static_cast<double>(rows)), 440 + 20 * rows, shortestNumber(low),
          shortestNumber(high), logarithmicTics(low, high), columns,
          gnuplotQuoted(report.distanceLabel + (seen.empty() ? "" : ", " + seen)),
          gnuplotQuoted(report.probabilityLabel + (bars ? "; bars: range over views" : ""))));
  runGnuplot(folder, name + ".gp", {name + ".svg"});
  return base.string() + ".svg";
}

}  // namespace limen::analysis
