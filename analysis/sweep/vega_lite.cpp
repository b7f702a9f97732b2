// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <nlohmann/json.hpp>

#include "analysis/sweep/chart.h"
#include "analysis/sweep/exchange.h"
#include "experiments/base/error.h"
#include "experiments/base/gnuplot.h"

namespace limen::analysis {
namespace {

using nlohmann::json;

/// Logarithmic as in the report, where values allow; a symmetric logarithm shows zero as well.
json scaleOf(const Sweep& sweep, const std::optional<double> Cell::*value, bool linear) {
  if (linear) return {{"zero", false}};
  double least = 0.0;
  bool hasZero = false;
  for (const Cell& cell : sweep.cells) {
    if (!cell.isDrawn()) continue;
    const double v = *(cell.*value);
    if (v <= 0.0) hasZero = true;
    if (v > 0.0 && (least == 0.0 || v < least)) least = v;
  }
  if (!hasZero) return {{"type", "log"}};
  return {{"type", "symlog"}, {"constant", least > 0.0 ? least : 1.0}};
}

json channel(const char* field, const Axis& axis, json scale, bool upsideDown) {
  if (upsideDown) scale["reverse"] = true;
  return {{"field", field}, {"type", "quantitative"}, {"title", axis.label()}, {"scale", scale}};
}

json rowOf(const Sweep& sweep, const Cell& cell) {
  json row = {{"key", cell.run.key},
              {"x", *cell.x},
              {"y", *cell.y},
              {"x_low", cell.interval ? cell.interval->low : *cell.x},
              {"x_high", cell.interval ? cell.interval->high : *cell.x},
              {"series", sweep.series.at(cell.series)},
              {"panel", sweep.panels.at(cell.panel).title},
              {"setting", sweep.label(cell)},
              {"front", cell.frontNumber > 0}};
  for (const Axis& column : sweep.varyingColumns)
    if (const auto found = cell.varying.find(column.name); found != cell.varying.end())
      row["parameters"][column.label()] = found->second;
  return row;
}

}  // namespace

std::string vegaLite(const Sweep& sweep) {
  json values = json::array();
  bool anyFront = false;
  for (const Cell& cell : sweep.cells) {
    if (!cell.isDrawn()) continue;
    values.push_back(rowOf(sweep, cell));
    anyFront = anyFront || cell.frontNumber > 0;
  }
  if (values.empty())
    throw Error("no run has both " + sweep.x.label() + " and " + sweep.y.label(), sweep.experiment.title,
                "name measured quantities in the descriptor's report");
  const json x = channel("x", sweep.x, scaleOf(sweep, &Cell::x, false), false),
             y = channel("y", sweep.y, scaleOf(sweep, &Cell::y, sweep.y.higherIsBetter()),
                         sweep.y.higherIsBetter());
  std::vector<std::string> names = sweep.series, colours;
  for (size_t i = 0; i < names.size(); ++i) colours.emplace_back(kChartColours[i % kChartColours.size()]);
  json layers = json::array();
  if (anyFront) {
    layers.push_back(
        {{"transform", {{{"filter", "datum.front"}}}},
         {"mark", {{"type", "line"}, {"interpolate", "step-after"}, {"color", "#777777"}}},
         {"encoding", {{"x", x}, {"y", y}, {"order", {{"field", "x"}, {"type", "quantitative"}}}}}});
  }
  const json colour = {{"field", "series"},
                       {"type", "nominal"},
                       {"title", sweep.names.heading(sweep.seriesName)},
                       {"scale", {{"domain", names}, {"range", colours}}}};
  json low = x;
  low["field"] = "x_low";
  layers.push_back({{"mark", "rule"},
                    {"encoding", {{"x", low}, {"x2", {{"field", "x_high"}}}, {"y", y}, {"color", colour}}}});
  layers.push_back({{"mark", {{"type", "point"}, {"filled", true}, {"size", 60}}},
                    {"encoding",
                     {{"x", x},
                      {"y", y},
                      {"color", colour},
                      {"shape",
                       {{"field", "series"},
                        {"type", "nominal"},
                        {"title", colour["title"]},
                        {"scale", {{"domain", names}}}}},
                      {"tooltip",
                       {{{"field", "setting"}, {"title", "Setting"}},
                        {{"field", "x"}, {"type", "quantitative"}, {"title", sweep.x.label()}},
                        {{"field", "y"}, {"type", "quantitative"}, {"title", sweep.y.label()}}}}}}});
  std::string description = sweep.experiment.question;
  if (!sweep.isComplete())
    description += " (Not complete: " + std::to_string(sweep.failed.size()) + " runs failed, " +
                   std::to_string(sweep.missing.size()) + " are missing.)";
  if (sweep.software)
    description += " (Times of a software renderer: they compare techniques on a CPU only.)";
  const json spec = {{"$schema", "https://vega.github.io/schema/vega-lite/v5.json"},
                     {"title", sweep.experiment.title},
                     {"description", description},
                     {"data", {{"values", values}}},
                     {"facet", {{"field", "panel"}, {"type", "nominal"}, {"title", nullptr}}},
                     {"columns", sweep.panels.size() > 1 ? 2 : 1},
                     {"spec", {{"width", 420}, {"height", 300}, {"layer", layers}}}};
  return spec.dump(1, ' ', false, json::error_handler_t::replace) + "\n";
}

}  // namespace limen::analysis
