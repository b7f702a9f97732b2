// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "analysis/output/chart_file.h"
#include "analysis/output/text_output.h"
#include "analysis/sweep/switch_distances.h"
#include "experiments/base/gnuplot.h"
#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

using Place = Crossing::Place;

std::optional<double> within(const std::optional<Crossing>& crossing) {
  return crossing && crossing->place == Place::Within ? std::optional(crossing->x) : std::nullopt;
}

/// How an estimate lies to the measured distances, as a word.
const char* boundWord(const std::optional<Crossing>& crossing) {
  if (!crossing) return "none";
  return crossing->place == Place::AtOrBelowFirst ? "at_or_below_nearest"
         : crossing->place == Place::BeyondLast   ? "beyond_farthest"
                                                  : "within";
}

std::string distanceText(const std::optional<Crossing>& crossing) {
  if (!crossing) return "-";
  return (crossing->place == Place::AtOrBelowFirst ? "<= "
          : crossing->place == Place::BeyondLast   ? "> "
                                                   : "") +
         formatNumber(crossing->x);
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

/// One distance of one switch: over the views.
struct CurvePoint {
  const SwitchDistance* own;
  double distance, mean, fit, lowest, highest;
};

std::vector<CurvePoint> curveOf(const SwitchDistance& one) {
  std::vector<CurvePoint> out;
  std::vector<double> means;
  for (size_t i = 0; i < one.distances.size(); ++i) {
    CurvePoint point{&one, one.distances[i], 0.0, 0.0, INFINITY, -INFINITY};
    for (const std::vector<double>& view : one.views) {
      point.mean += view[i] / static_cast<double>(one.views.size());
      point.lowest = std::min(point.lowest, view[i]);
      point.highest = std::max(point.highest, view[i]);
    }
    means.push_back(point.mean);
    out.push_back(point);
  }
  const std::vector<double> fit = fitNonIncreasing(means);
  for (size_t i = 0; i < fit.size(); ++i) out[i].fit = fit[i];
  return out;
}

ResultTable switchTable(const SwitchReport& report) {
  const auto crossing = [](auto make, auto member) {
    return [=](const SwitchDistance& one) { return make(one.estimate.*member); };
  };
  TableOf out("switches", "", report.switches);
  out.add(forPeople(text("", "switch")), nameOf)
      .add(forData(text("technique")), &SwitchDistance::technique)
      .add(forData(text("scene")), &SwitchDistance::scene);
  std::set<std::string> names;
  for (const SwitchDistance& one : report.switches)
    for (const auto& [name, value] : one.condition) names.insert(name);
  for (const std::string& name : names)
    out.add(forData(text(name)), [name](const SwitchDistance& one) {
      const auto found = one.condition.find(name);
      return found == one.condition.end() ? ResultCell() : ResultCell(found->second);
    });
  const auto add = [&](const std::string& name, const std::string& title, auto member) {
    out.add(forData(number(name)), crossing(within, member))
        .add(forData(text((name == "estimate" ? "" : name + "_") + "bound")), crossing(boundWord, member));
    if (!title.empty()) out.add(forPeople(text("", title)), crossing(distanceText, member));
  };
  add("estimate", "distance", &CrossingEstimate::ofMean);
  add("low", "", &CrossingEstimate::low);
  add("high", "", &CrossingEstimate::high);
  out.add(forPeople(text("", fmt::format("{:g} % interval", 100.0 * report.confidence))),
          [](const SwitchDistance& one) {
            const CrossingEstimate& own = one.estimate;
            return own.low ? distanceText(own.low) + " to " + distanceText(own.high) : "one view: none";
          });
  add("every_view", "every view", &CrossingEstimate::farthest);
  return out.add(integer("views"), [](const SwitchDistance& one) { return one.views.size(); });
}

}  // namespace

Result resultOf(const SwitchReport& report) {
  Result out;
  out.command = "switch-distances";
  Section& head = out.head;
  head.title = report.title + "\nnearest distance at which a switch is seen with a probability of " +
               shortestNumber(report.probability) + " at most";
  if (const std::string seen = seenText(report); !seen.empty()) head.title += "\n" + seen;
  head.fact(forData(text("title")), report.title);
  head.fact(forData(text("experiment")), report.hash);
  head.fact(forData(number("probability")), report.probability);
  head.fact(forData(number("level")), report.confidence);
  head.fact(forData(integer("runs_left_out")), report.leftOut);
  for (const auto& [name, value] : report.seen) head.fact(forData(text(name)), value);
  head.add(switchTable(report));
  std::vector<CurvePoint> points;
  for (const SwitchDistance& one : report.switches)
    for (const CurvePoint& point : curveOf(one)) points.push_back(point);
  head.add(
      TableOf("curves", "", points)
          .add(forData(text("technique")), at(&CurvePoint::own, &SwitchDistance::technique))
          .add(forData(text("scene")), at(&CurvePoint::own, &SwitchDistance::scene))
          .add(forData(text("condition")), [](const CurvePoint& point) { return nameOf(*point.own); })
          .add(forData(integer("views")), [](const CurvePoint& point) { return point.own->views.size(); })
          .add(forData(number("distance")), &CurvePoint::distance)
          .add(forData(number("probability_mean")), &CurvePoint::mean)
          .add(forData(number("probability_fit")), &CurvePoint::fit)
          .add(forData(number("probability_lowest")), &CurvePoint::lowest)
          .add(forData(number("probability_highest")), &CurvePoint::highest));
  head.notes.push_back("distance: of the mean over views; every view: none is seen more often from there on");
  if (report.leftOut > 0)
    head.notes.push_back(
        fmt::format("{} planned runs are missing or failed and were left out", report.leftOut));
  return out;
}

std::string drawSwitchChart(const SwitchReport& report, const std::string& path) {
  constexpr size_t kMostWithBars = 8;  // with more curves the views' ranges hide them; the table has them
  const ChartFile file(path);
  double nearest = INFINITY, farthest = 0.0;
  size_t longest = 0;
  for (const SwitchDistance& one : report.switches) {
    nearest = std::min(nearest, one.distances.front());
    farthest = std::max(farthest, one.distances.back());
    longest = std::max(longest, nameOf(one).size());
  }
  const size_t count = report.switches.size();
  const double low = nearest / 1.15, high = farthest * 1.15, apart = std::pow(high / low, 0.004);
  const bool bars = count <= kMostWithBars;
  // Data sets: for each switch the curve of all views together with the views' range, then its crossing. The
  // bars are set a little apart so that those of one distance do not hide one another.
  std::string data, plots;
  for (size_t index = 0; index < count; ++index) {
    const SwitchDistance& one = report.switches[index];
    data += "# " + nameOf(one) + ": distance, mean, lowest and highest probability\n";
    for (const CurvePoint& point : curveOf(one))
      data += fmt::format("{} {} {} {}\n", point.distance, point.mean, point.lowest, point.highest);
    const CrossingEstimate& estimate = one.estimate;
    data += fmt::format(
        "\n\n# where it comes down to the probability: distance, probability, low, high\n{} {} {} {}\n\n\n",
        estimate.ofMean.place == Place::Within ? shortestNumber(estimate.ofMean.x) : "NaN",
        report.probability, estimate.low.value_or(estimate.ofMean).x,
        estimate.high.value_or(estimate.ofMean).x);
    const std::string look = seriesStyle(index), next = plots.empty() ? "" : ", \\\n  ";
    if (bars)
      plots += fmt::format("{}{} index {} using ($1*{}):2:3:4 with yerrorbars {} ps 0 lw 1 notitle, ", next,
                           file.data(), 2 * index,
                           std::pow(apart, static_cast<double>(index) - 0.5 * static_cast<double>(count - 1)),
                           look);
    plots += fmt::format(
        "{}{} index {} using 1:2 with linespoints {} pt {} ps 0.6 lw 2 title {}, {} index {} using 1:2:3:4 "
        "with "
        "xerrorbars {} pt 7 ps 1.1 lw 2.5 notitle",
        bars ? "" : next, file.data(), 2 * index, look, 4 + index % 10, gnuplotQuoted(nameOf(one)),
        file.data(), 2 * index + 1, look);
  }
  const size_t columns = std::clamp<size_t>(84 / (longest + 8), 1, 4), rows = (count + columns - 1) / columns;
  const std::string seen = seenText(report);
  file.draw(
      file.head(1.2, 1.2 + 0.05 * static_cast<double>(rows)) +
          fmt::format(
              "set logscale x\nset xrange [{}:{}]\n{}set mxtics 1\nset rmargin 4\n"
              "set key outside below noenhanced maxcols {} samplen 3\nset grid lt 1 lw 0.5 lc rgb '#dddddd'\n"
              "set bars 0.5\nset title {} noenhanced\nset xlabel {} noenhanced\nset ylabel {}\n"
              "set yrange [0:1]\nset arrow from graph 0, first {} to graph 1, first {} nohead dt 2 lc rgb "
              "'#777777'\nplot {}\n",
              low, high, logarithmicTics(low, high), columns, gnuplotQuoted(report.title),
              gnuplotQuoted(report.distanceLabel + (seen.empty() ? "" : ", " + seen)),
              gnuplotQuoted(report.probabilityLabel + (bars ? "; bars: range over views" : "")),
              report.probability, report.probability, plots),
      data);
  return path;
}

}  // namespace limen::analysis
