// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/statistics/summary.h"
#include "analysis/sweep/sweep.h"

namespace limen::analysis {

/// Series are told apart by shape and colour; after so many the shapes come again in another order.
inline constexpr int kMarkerShapes = 7;

struct ChartMark {
  double x = 0.0, y = 0.0;
  std::optional<MedianInterval> interval;  ///< of x
  size_t series = 0;
  bool onFront = false;  ///< drawn strongly
  int frontNumber = 0;   ///< printed beside the mark; 0: none
  std::string key;       ///< of the run
  std::string label;     ///< what it is
  std::string hover;     ///< lines of text, separated by line feeds
  bool ringed = false;   ///< the cheapest within the chart's limit
};

/// Marks of one panel, written as gnuplot script and data and drawn as SVG.
struct Chart {
  std::string name;   ///< id prefix in the page and file name: "panel_1"
  std::string title;  ///< for the file and for readers of the screen; the page has its own heading
  std::string xTitle, yTitle;
  bool yUpsideDown = false;  ///< linear and reversed, so that better is always below
  std::vector<ChartMark> marks;
  std::vector<size_t> front;         ///< indices of marks, from fast to exact; empty: no line
  std::optional<double> limit = {};  ///< drawn as a line across, at this value of y
  std::string limitLabel = {};       ///< "1 JND"
  bool hasFront = true;              ///< a page that hides marks draws the front of the others
};

/// Range and ticks that the panels of a figure share.
struct ChartAxis {
  bool logarithmic = true;
  double low = 0.1, high = 1.0;  ///< of the axis as drawn
  std::optional<double> foot;    ///< where zero (or an infinite quality) stands, which the axis cannot show
  std::vector<std::pair<std::string, double>> ticks;
  std::vector<double> minorTicks;

  double place(double value) const;
  /// Of what it shows; in logarithms on a logarithmic axis.
  double length() const;
  bool isAtFoot(double value) const { return foot && place(value) == *foot; }
};

/// Round numbers within [low, high], in steps of 1, 2 or 5 times a power of ten; one more than
/// `steps` at most.
std::vector<double> roundLevels(double low, double high, int steps = 4);

/// An axis wide enough for all values. Not logarithmic only if told so.
ChartAxis makeChartAxis(const std::vector<double>& values, bool linear);

/// Writes NAME.gp, NAME.dat and NAME.svg into `folder`, draws with gnuplot and returns the SVG for the page:
/// ids made unique by the name, every mark a <g class="mark"> with its data. Throws Error if gnuplot is
/// missing or fails.
std::string drawChart(const Chart& chart, const ChartAxis& x, const ChartAxis& y, size_t seriesCount,
                      const std::string& folder);

/// Inline SVG of a series' marker, for legends and tables.
std::string markerSvg(size_t series);

}  // namespace limen::analysis
