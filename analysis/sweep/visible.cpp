// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/sweep/visible.h"

#include <algorithm>
#include <set>

#include "analysis/output/text_output.h"
#include "analysis/sweep/grouping.h"

namespace limen::analysis {
namespace {

std::string displaysOf(const Sweep& sweep) {
  std::set<std::string> found;
  for (const Cell& cell : sweep.cells)
    for (const nlohmann::json& metric : cell.run.parameters.value("metrics", nlohmann::json::array())) {
      if (!metric.contains("display")) continue;
      std::string text = metric["display"].get<std::string>();
      if (text == "file") text = metric.value("display.file", text);
      for (const char* path : {"display.distance_m", "display.distance.m"})
        if (metric.contains(path) && metric[path].is_number())
          text += " from " + formatNumber(metric[path].get<double>()) + " m";
      found.insert(text);
    }
  std::string out;
  for (const std::string& one : found) out += (out.empty() ? "" : ", ") + one;
  return out;
}

/// Not known where the cost is exact, or was measured once.
MedianInterval costInterval(const Sweep& sweep, const VisibleVerdict& visible, const Cell& cell) {
  const double cost = *visibleCost(sweep, visible, cell);
  return visible.cost.name == sweep.x.name && cell.interval ? *cell.interval
                                                            : MedianInterval{cost, cost, false};
}

VisibleChoice choose(const Sweep& sweep, const VisibleVerdict& visible, const Panel& panel,
                     const std::string& name) {
  VisibleChoice out;
  std::vector<size_t> below;
  double least = 0.0;
  for (const size_t index : panel.cells) {
    const Cell& cell = sweep.cells[index];
    const std::optional<double> value = measurementOf(cell.run, name);
    if (!value || !visibleCost(sweep, visible, cell)) continue;
    if (!out.least || *value < least) out.least = index, least = *value;
    if (*value < kVisibleFrom) below.push_back(index);
  }
  std::stable_sort(below.begin(), below.end(), [&](size_t a, size_t b) {
    return *visibleCost(sweep, visible, sweep.cells[a]) < *visibleCost(sweep, visible, sweep.cells[b]);
  });
  if (below.empty()) return out;
  out.cheapest = below.front();
  const double high = costInterval(sweep, visible, sweep.cells[below.front()]).high;
  for (size_t i = 1; i < below.size(); ++i)
    if (costInterval(sweep, visible, sweep.cells[below[i]]).low <= high) out.ties.push_back(below[i]);
  return out;
}

}  // namespace

std::optional<double> visibleCost(const Sweep& sweep, const VisibleVerdict& visible, const Cell& cell) {
  if (visible.cost.name == sweep.x.name) return cell.x;
  return measurementOf(cell.run, visible.cost.name);
}

VisibleVerdict findVisible(const Sweep& sweep) {
  VisibleVerdict out;
  const store::QuantityRow* x = sweep.names.descriptions().quantity(sweep.x.name);
  const bool isCost = x != nullptr && x->kind != "error" && x->direction == Direction::LowerIsBetter;
  out.cost = isCost ? sweep.x : sweep.names.axis("gpu_ms", sweep.software);
  out.displays = displaysOf(sweep);
  for (const store::QuantityRow& row : sweep.names.descriptions().quantities) {
    if (row.unit != kVisibleUnit || row.kind != "error" || row.direction != Direction::LowerIsBetter)
      continue;
    VisibleVerdict::Measure measure{sweep.names.axis(row.name), {}};
    bool any = false;
    for (const Panel& panel : sweep.panels) {
      measure.panels.push_back(choose(sweep, out, panel, row.name));
      any = any || measure.panels.back().least;
    }
    if (any) out.measures.push_back(std::move(measure));
  }
  return out;
}

}  // namespace limen::analysis
