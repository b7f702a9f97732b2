// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "analysis/gnuplot.h"
#include "analysis/switch_distances.h"
#include "analysis/text_output.h"
#include "base/text.h"

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
  for (const auto& [name, text] : one.condition) parts.push_back(name + "=" + text);
  return parts.empty() ? one.technique : join(parts);
}

std::vector<double> meanOf(const SwitchDistance& one) {
  std::vector<double> out(one.distances.size(), 0.0);
  for (const std::vector<double>& view : one.views)
    for (size_t i = 0; i < out.size(); ++i) out[i] += view[i] / static_cast<double>(one.views.size());
  return out;
}

}  // namespace

std::string toJson(const SwitchReport& report) {
  nlohmann::json out = {{"event", "switch_distances"},        {"title", report.title},
                        {"experiment", report.hash},          {"probability", report.probability},
                        {"confidence", report.confidence},    {"runs_left_out", report.leftOut},
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
  if (report.leftOut > 0)
    out += fmt::format("  {} planned runs are missing or failed and were left out\n", report.leftOut);
  return out;
}

std::string drawSwitchChart(const SwitchReport& report, const std::string& folder) {
  const std::string name = "switch_distances";
  const std::filesystem::path base = std::filesystem::path(folder) / name;
  // Data sets: for each switch the curve of all views together with the views' range, then its crossing.
  std::string data, plots;
  size_t index = 0;
  for (const SwitchDistance& one : report.switches) {
    const std::vector<double> mean = meanOf(one);
    data += "# " + nameOf(one) + ": distance, mean, lowest and highest probability\n";
    for (size_t i = 0; i < mean.size(); ++i) {
      double low = mean[i], high = mean[i];
      for (const std::vector<double>& view : one.views) {
        low = std::min(low, view[i]);
        high = std::max(high, view[i]);
      }
      data += fmt::format("{} {} {} {}\n", shortestNumber(one.distances[i]), shortestNumber(mean[i]),
                          shortestNumber(low), shortestNumber(high));
    }
    const CrossingEstimate& estimate = one.estimate;
    const double low = estimate.low ? estimate.low->x : estimate.ofMean.x;
    const double high = estimate.high ? estimate.high->x : estimate.ofMean.x;
    data += fmt::format(
        "\n\n# where it comes down to the probability: distance, probability, low, high\n{} {} {} {}\n\n\n",
        estimate.ofMean.place == Place::Within ? shortestNumber(estimate.ofMean.x) : "NaN",
        shortestNumber(report.probability), shortestNumber(low), shortestNumber(high));
    const size_t colour = index / 2 + 1;
    plots += fmt::format(
        "{0}'{1}.dat' index {2} using 1:2:3:4 with yerrorlines lc {3} pt {3} lw 1.5 title {4}, \\\n"
        "  '' index {5} using 1:2:3:4 with xerrorbars lc {3} pt 7 ps 1.3 lw 2.5 notitle",
        plots.empty() ? "" : ", \\\n  ", name, index, colour, gnuplotQuoted(nameOf(one)), index + 1);
    index += 2;
  }
  writeFileBytes(base.string() + ".dat", data);
  writeFileBytes(
      base.string() + ".gp",
      fmt::format(
          "# Draws {0}.svg from {0}.dat. For a paper: gnuplot -e pdf=1 {0}.gp\nreset\n"
          "if (exists('pdf')) {{\n  set terminal pdfcairo size 14cm,9cm font 'sans,10'\n"
          "  set output '{0}.pdf'\n}} else {{\n"
          "  set terminal svg size 760,480 dynamic font 'DejaVu Sans,13' background '#ffffff' noenhanced\n"
          "  set output '{0}.svg'\n}}\n"
          "set encoding utf8\nset border 3\nset tics nomirror out\nset logscale x\n"
          "set key outside below noenhanced\nset grid lt 1 lw 0.5 lc rgb '#dddddd'\n"
          "set title {1} noenhanced\nset xlabel 'distance (world units)'\n"
          "set ylabel 'probability of detection; bars: range over views'\nset yrange [0:1]\n"
          "set arrow from graph 0, first {2} to graph 1, first {2} nohead dt 2 lc rgb '#777777'\n"
          "plot {3}\n",
          name, gnuplotQuoted(report.title), shortestNumber(report.probability), plots));
  runGnuplot(folder, name + ".gp");
  return base.string() + ".svg";
}

}  // namespace limen::analysis
