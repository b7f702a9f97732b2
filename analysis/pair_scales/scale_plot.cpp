// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>

#include "analysis/correlations/bootstrap_facts.h"
#include "analysis/output/chart_file.h"
#include "analysis/pair_scales/scale.h"
#include "experiments/base/error.h"
#include "experiments/base/gnuplot.h"

namespace limen::analysis {
namespace {

/// What the bars are.
std::string barsText(const ItemScale& scale, const ScaleSetting& setting) {
  const std::string level = levelText(setting.bootstrap.level);
  switch (scale.bootstrap) {
    case ScaleBootstrap::Subjects:
      return level + " bootstrap over subjects";
    case ScaleBootstrap::Judgements:
      return level + " bootstrap over judgements";
    case ScaleBootstrap::None:
      break;
  }
  return level + ", value +- z error";
}

}  // namespace

void drawScales(const Scales& scales, const std::string& path) {
  const ChartFile file(path);
  if (scales.groups.empty()) throw Error("there is nothing to draw", path);
  const ScaleSetting& setting = scales.setting;
  const PanelGrid grid = arrangePanels(scales.groups.size());
  size_t most = 0;
  double low = 0.0, high = 0.0;
  for (const ItemScale& scale : scales.groups) {
    most = std::max(most, scale.items.size());
    for (const ScaledItem& item : scale.items) {
      const auto bar = item.bootstrap && item.bootstrap->interval ? item.bootstrap->interval : item.interval;
      low = std::min({low, item.value, bar ? bar->low : item.value});
      high = std::max({high, item.value, bar ? bar->high : item.value});
    }
  }
  const double margin = high > low ? 0.05 * (high - low) : 1.0;
  const double height = std::max(0.5, 0.25 + 0.07 * static_cast<double>(most));
  const bool single = scales.groups.size() == 1;
  std::string script =
      file.head((single ? 1.0 : 0.85) * static_cast<double>(grid.columns),
                height * static_cast<double>(grid.rows)) +
      fmt::format(
          "set xrange [{}:{}]\nset key off\nset grid ytics lc rgb '#DDDDDD' dt 1\nset tics noenhanced\n"
          "set arrow from 0, graph 0 to 0, graph 1 nohead lc rgb '#999999'\n",
          low - margin, high + margin);
  const std::string zero = setting.reference.empty() ? "values sum to 0" : setting.reference + " is 0";
  const std::string kind = fmt::format("{}; {}", modelName(setting.model), zero);
  if (!single)
    script += fmt::format("set multiplot layout {},{} title {} noenhanced\n", grid.rows, grid.columns,
                          gnuplotQuoted(kind));
  std::string data;
  size_t block = 0;
  for (const ItemScale& scale : scales.groups) {
    std::string names;
    for (size_t i = 0; i < scale.items.size(); ++i) {
      const ScaledItem& item = scale.items[i];
      const auto drawn = boundsOf(item.bootstrap);
      const Interval bar = drawn ? *drawn : item.interval.value_or(Interval{item.value, item.value});
      const size_t row = scale.items.size() - i;
      data += fmt::format("{} {} {} {}\n", item.value, row, bar.low, bar.high);
      names += fmt::format("{}{} {}", i ? ", " : "", gnuplotTick(item.name), row);
    }
    data += "\n\n";
    const std::string bars = barsText(scale, setting);
    script += "set title " + gnuplotQuoted(single ? "" : scale.name + " (" + bars + ")") +
              " noenhanced\nset xlabel " +
              gnuplotQuoted(single ? "scale value (" + kind + "; " + bars + ")" : "scale value") +
              " noenhanced\nset ytics (" + names + ")\n" +
              fmt::format(
                  "set yrange [0.4:{}.6]\nplot {} index {} using 1:2:3:4 with xerrorbars pt 7 ps 0.9 lw "
                  "1.5 lc rgb '{}'\n",
                  scale.items.size(), file.data(), block++, kChartColours[0]);
  }
  if (!single) script += "unset multiplot\n";
  file.draw(script, data);
}

}  // namespace limen::analysis
