// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>

#include "analysis/output/text_table.h"
#include "analysis/output/chart_file.h"
#include "analysis/correlations/correlations.h"
#include "experiments/base/error.h"
#include "experiments/base/gnuplot.h"

namespace limen::analysis {
namespace {

/// A pair of columns with the groups that have it.
struct Panel {
  std::string x, y;
  std::vector<std::pair<size_t, const Relation*>> series;  ///< number of the group
};

std::vector<Panel> panelsOf(const Correlations& correlations) {
  std::vector<Panel> out;
  for (size_t i = 0; i < correlations.groups.size(); ++i)
    for (const Relation& relation : correlations.groups[i].relations) {
      auto panel = std::find_if(out.begin(), out.end(),
                                [&](const Panel& one) { return one.x == relation.x && one.y == relation.y; });
      if (panel == out.end()) panel = out.insert(out.end(), {relation.x, relation.y, {}});
      panel->series.push_back({i, &relation});
    }
  return out;
}

std::string numbersOf(const Relation& relation, bool intervals) {
  std::string out;
  for (const char* name : {"kendall_tau_b", "pearson"})
    for (const RelationCoefficient& one : relation.coefficients) {
      if (one.name != name) continue;
      if (!out.empty()) out += ", ";
      out += std::string(one.name == "pearson" ? "r" : "τ_b") + " = " +
             fixedText(one.coefficient ? std::optional<double>(one.coefficient->value) : std::nullopt, 2);
      const auto interval = one.bootstrap     ? one.bootstrap->interval
                            : one.coefficient ? one.coefficient->interval
                                              : std::nullopt;
      if (intervals && interval && interval->low < interval->high)
        out += fmt::format(" ({:.2f} to {:.2f})", interval->low, interval->high);
    }
  return out;
}

}  // namespace

void drawCorrelations(const Correlations& correlations, const std::string& path) {
  const ChartFile file(path);
  const std::vector<Panel> panels = panelsOf(correlations);
  if (panels.empty()) throw Error("there is nothing to draw", path);
  const PanelGrid grid = arrangePanels(panels.size());
  const bool single = panels.size() == 1;
  const double scale = single ? 1.0 : 0.75;
  std::string script =
      file.head(scale * static_cast<double>(grid.columns), scale * static_cast<double>(grid.rows)) +
      "set autoscale xfix\nset autoscale yfix\nset offsets graph 0.04, graph 0.04, graph 0.04, graph 0.04\n";
  if (!single) script += fmt::format("set multiplot layout {},{}\n", grid.rows, grid.columns);
  std::string data;
  size_t block = 0;
  for (const Panel& panel : panels) {
    const bool several = panel.series.size() > 1;
    script += "set xlabel " + gnuplotQuoted(panel.x) + " noenhanced\nset ylabel " + gnuplotQuoted(panel.y) +
              " noenhanced\nset title " +
              gnuplotQuoted(several ? "" : numbersOf(*panel.series.front().second, true)) +
              " noenhanced\nset key " + (several ? "outside below Left reverse noenhanced" : "off") +
              "\nplot ";
    for (const auto& [group, relation] : panel.series) {
      const std::string& name = correlations.groups[group].name;
      for (size_t i = 0; i < relation->xs.size(); ++i)
        data += fmt::format("{} {}\n", relation->xs[i], relation->ys[i]);
      data += "\n\n";
      const std::string title = (name.empty() ? "" : name + ": ") + numbersOf(*relation, false);
      // See-through, as answers often fall on the same place.
      const std::string colour = kChartColours[group % kChartColours.size()];
      script += fmt::format("{}{} index {} using 1:2 with points pt {} ps 0.8 lc rgb '#60{}' title {}",
                            relation == panel.series.front().second ? "" : ", \\\n  ", file.data(), block++,
                            group / kChartColours.size() % 2 ? 5 : 7, colour.substr(1), gnuplotQuoted(title));
    }
    script += "\n";
  }
  if (!single) script += "unset multiplot\n";
  file.draw(script, data);
}

}  // namespace limen::analysis
