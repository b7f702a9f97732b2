// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/sweep/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "analysis/output/page.h"
#include "analysis/output/text_output.h"
#include "experiments/base/error.h"
#include "experiments/base/gnuplot.h"
#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

namespace fs = std::filesystem;

// gnuplot's point types and the page's own marker shapes go with kChartColours, which the page's style sheet
// gives again for a dark page.
static_assert(kMarkerShapes == kChartColours.size());
constexpr std::array<int, kMarkerShapes> kPointTypes = {7, 5, 9, 13, 11, 6, 4};
constexpr std::array<const char*, kMarkerShapes> kMarkerPaths = {
    "<circle cx='8' cy='8' r='5' fill='currentColor'/>",
    "<rect x='3.5' y='3.5' width='9' height='9' fill='currentColor'/>",
    "<path d='M8,2 L14,12.5 L2,12.5 z' fill='currentColor'/>",
    "<path d='M8,1.5 L14.5,8 L8,14.5 L1.5,8 z' fill='currentColor'/>",
    "<path d='M8,14 L14,3.5 L2,3.5 z' fill='currentColor'/>",
    "<circle cx='8' cy='8' r='4.8' fill='none' stroke='currentColor' stroke-width='2'/>",
    "<rect x='3.5' y='3.5' width='9' height='9' fill='none' stroke='currentColor' stroke-width='2'/>"};

// After all seven pairs have been used, shapes move on by one against colours, so that 49 pairs differ.
size_t shapeOf(size_t series) { return (series + series / kMarkerShapes) % kMarkerShapes; }
size_t colourOf(size_t series) { return series % kMarkerShapes; }

std::string ticksScript(const char* axisName, const ChartAxis& axis) {
  std::string out;
  const auto add = [&](const std::string& label, double value, int level) {
    out +=
        fmt::format("{}{} {} {}", out.empty() ? "" : ", ", gnuplotTick(label), shortestNumber(value), level);
  };
  for (const auto& [label, value] : axis.ticks) add(label, value, 0);
  for (const double value : axis.minorTicks) add("", value, 1);
  return fmt::format("set {}tics ({})\n", axisName, out);
}

std::string script(const Chart& chart, const ChartAxis& x, const ChartAxis& y, size_t seriesCount) {
  const bool reversed = chart.yUpsideDown;
  std::string out = fmt::format(
      "# Draws {0}.svg from {0}.dat. For a paper: gnuplot -e pdf=1 {0}.gp\nreset\nif (exists('pdf')) {{\n"
      "  set terminal pdfcairo size 12cm,8cm font 'sans,10'\n  set output '{0}.pdf'\n  set title {1} "
      "noenhanced\n"
      "}} else {{\n"
      "  set terminal svg name '{0}' size 640,430 dynamic font 'system-ui, sans-serif,13' noenhanced\n"
      "  set output '{0}.svg'\n}}\n"
      "set encoding utf8\nset datafile separator ' '\nset key off\nset border 3\nset tics nomirror out\n"
      "set errorbars 0\nset grid xtics ytics lt 1 lw 0.5 lc rgb '#dddddd'\n"
      "set xlabel {2} noenhanced\nset ylabel {3} noenhanced\n{4}{5}set xrange [{6}:{7}]\nset yrange "
      "[{8}:{9}]\n",
      chart.name, gnuplotQuoted(chart.title), gnuplotQuoted(chart.xTitle), gnuplotQuoted(chart.yTitle),
      x.logarithmic ? "set logscale x\n" : "", y.logarithmic ? "set logscale y\n" : "", shortestNumber(x.low),
      shortestNumber(x.high), shortestNumber(reversed ? y.high : y.low),
      shortestNumber(reversed ? y.low : y.high));
  out += ticksScript("x", x) + ticksScript("y", y);
  if (chart.limit && y.low <= *chart.limit && *chart.limit <= y.high)
    out += fmt::format(
        "set arrow 1 from graph 0, first {0} to graph 1, first {0} nohead dashtype 2 lw 1 lc rgb '#777777'\n"
        "set label 1 {1} at graph 0.99, first {0} right offset 0, 0.5 noenhanced\n",
        shortestNumber(*chart.limit), gnuplotQuoted(chart.limitLabel));
  // Data set 0 is the front (with its ends at the border), then comes one for each series: x, y, low, high.
  std::string plots = "'" + chart.name + ".dat' index 0 using 1:2 with steps lw 2 lc rgb '#777777'";
  for (size_t series = 0; series < seriesCount; ++series)
    plots += fmt::format(
        ", \\\n  '' index {0} using 1:2:3:4 with xerrorbars pt 0 lw 1.5 lc rgb '{1}'"
        ", \\\n  '' index {0} using 1:2 with points pt {2} ps 1.1 lw 1.5 lc rgb '{1}'",
        series + 1, kChartColours[colourOf(series)], kPointTypes[shapeOf(series)]);
  return out + "plot " + plots + "\n";
}

std::string data(const Chart& chart, const ChartAxis& x, const ChartAxis& y, size_t seriesCount) {
  const auto row = [](double a, double b, double c, double d) {
    return fmt::format("{} {} {} {}\n", shortestNumber(a), shortestNumber(b), shortestNumber(c),
                       shortestNumber(d));
  };
  std::string out = "# front: x y\n";
  for (const size_t index : chart.front) {
    const ChartMark& mark = chart.marks[index];
    const double px = x.place(mark.x), py = y.place(mark.y);
    if (index == chart.front.front()) out += row(px, chart.yUpsideDown ? y.low : y.high, px, px);
    out += row(px, py, px, px);
    if (index == chart.front.back()) out += row(x.high, py, px, px);
  }
  // An empty data set would shift the numbers of those after it.
  if (chart.front.empty()) out += "NaN NaN NaN NaN\n";
  for (size_t series = 0; series < seriesCount; ++series) {
    out += fmt::format("\n\n# series {}: x y low high\n", series);
    bool any = false;
    for (const ChartMark& mark : chart.marks) {
      if (mark.series != series) continue;
      any = true;
      const double px = x.place(mark.x);
      const MedianInterval bar = mark.interval.value_or(MedianInterval{px, px, false});
      out +=
          row(px, y.place(mark.y), std::clamp(bar.low, x.low, x.high), std::clamp(bar.high, x.low, x.high));
    }
    if (!any) out += "NaN NaN NaN NaN\n";
  }
  return out;
}

struct Place {
  double x = 0.0, y = 0.0;
};

// "<use xlink:href='#gpPt6' transform='translate(139.25,45.71) scale(5.85)' ...": where gnuplot put the
// point.
Place placeOf(const std::string& use) {
  Place place;
  const size_t at = use.find("translate(");
  if (at != std::string::npos) std::sscanf(use.c_str() + at, "translate(%lf,%lf)", &place.x, &place.y);
  return place;
}

// Beside the mark, where it hits neither another mark nor another number.
Place placeNumber(const Place& mark, std::vector<Place>& taken) {
  constexpr std::array<Place, 4> kOffsets = {Place{13, -9}, Place{-12, 11}, Place{12, 11}, Place{-12, -10}};
  const auto room = [&](const Place& at) {
    double nearest = 1e9;
    for (const Place& other : taken) nearest = std::min(nearest, std::hypot(other.x - at.x, other.y - at.y));
    return nearest;
  };
  Place best;
  double bestRoom = -1.0;
  for (const Place& offset : kOffsets) {
    const Place at{mark.x + offset.x, mark.y + offset.y};
    const double found = std::min(room(at), 12.0);  // enough is enough: the first good place wins
    if (found <= bestRoom) continue;
    best = at;
    bestRoom = found;
  }
  taken.push_back(best);
  return best;
}

std::string decorate(const ChartMark& mark, const std::string& use, std::vector<Place>& taken) {
  const Place place = placeOf(use);
  std::string spoken = mark.hover;
  std::replace(spoken.begin(), spoken.end(), '\n', ';');
  std::string number;
  if (mark.frontNumber > 0) {
    const Place at = placeNumber(place, taken);
    number = fmt::format("<text class=\"number\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", at.x, at.y + 4,
                         mark.frontNumber);
  }
  const std::string ring =
      mark.ringed
          ? fmt::format("<circle class=\"ring\" cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"10\"/>", place.x, place.y)
          : "";
  return fmt::format(
      "<g class=\"mark s{}{}\" data-series=\"{}\" data-run=\"{}\" data-label=\"{}\" data-x=\"{}\" "
      "data-y=\"{}\" data-hover=\"{}\" tabindex=\"0\" role=\"img\" aria-label=\"{}\">{}{}<circle "
      "class=\"hit\" "
      "cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"11\"/>{}</g>",
      colourOf(mark.series), mark.onFront ? " front" : "", mark.series, escapeHtml(mark.key),
      escapeHtml(mark.label), shortestNumber(mark.x), shortestNumber(mark.y), escapeHtml(mark.hover),
      escapeHtml(spoken), use, ring, place.x, place.y, number);
}

// gnuplot writes the points of a plot in the order of its data, so the n-th <use> of a series is its n-th
// mark.
std::string nameMarks(const std::string& svg, const Chart& chart, size_t seriesCount) {
  std::vector<std::vector<const ChartMark*>> bySeries(seriesCount);
  for (const ChartMark& mark : chart.marks) bySeries[mark.series].push_back(&mark);
  std::vector<Place> taken;
  for (size_t at = 0; (at = svg.find("transform='translate(", at)) != std::string::npos; ++at)
    taken.push_back(placeOf(svg.substr(at, 60)));
  std::string out = svg;
  for (size_t series = 0; series < seriesCount; ++series) {
    const std::string bars = fmt::format("id=\"{}_plot_{}\"", chart.name, 2 + 2 * series);
    const std::string points = fmt::format("id=\"{}_plot_{}\"", chart.name, 3 + 2 * series);
    replaceAll(out, bars,
               fmt::format("{} class=\"bars s{}\" data-series=\"{}\"", bars, colourOf(series), series));
    size_t at = out.find(points);
    for (const ChartMark* mark : bySeries[series]) {
      at = at == std::string::npos ? at : out.find("<use ", at);
      const size_t end = at == std::string::npos ? at : out.find("/>", at);
      if (end == std::string::npos) throw Error("gnuplot left out a point of " + chart.name);
      const std::string marked = decorate(*mark, out.substr(at, end + 2 - at), taken);
      out.replace(at, end + 2 - at, marked);
      at += marked.size();
    }
  }
  return out;
}

}  // namespace

std::string drawChart(const Chart& chart, const ChartAxis& x, const ChartAxis& y, size_t seriesCount,
                      const std::string& folder) {
  const fs::path base = fs::path(folder) / chart.name;
  writeFileBytes(base.string() + ".gp", script(chart, x, y, seriesCount));
  writeFileBytes(base.string() + ".dat", data(chart, x, y, seriesCount));
  runGnuplot(folder, chart.name + ".gp", {chart.name + ".svg"});
  const std::string svg = inlineSvg(readFileBytes(base.string() + ".svg"), chart.name,
                                    chart.title + ": " + chart.yTitle + " against " + chart.xTitle, "group");
  std::string out = nameMarks(svg, chart, seriesCount);
  const std::string front = fmt::format("id=\"{}_plot_1\"", chart.name);
  if (chart.hasFront)
    replaceAll(
        out, front,
        fmt::format("{} class=\"front-line\" data-better=\"{}\"", front, chart.yUpsideDown ? "high" : "low"));
  return out;
}

std::string markerSvg(size_t series) {
  return fmt::format("<svg class=\"marker s{}\" viewBox=\"0 0 16 16\" aria-hidden=\"true\">{}</svg>",
                     colourOf(series), kMarkerPaths[shapeOf(series)]);
}

}  // namespace limen::analysis
