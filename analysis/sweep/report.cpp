// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/sweep/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <system_error>

#include "analysis/output/text_output.h"
#include "analysis/sweep/chart.h"
#include "analysis/sweep/page.h"
#include "analysis/sweep/trade_off.h"
#include "analysis/sweep/visible.h"
#include "experiments/base/error.h"
#include "experiments/base/staged_folder.h"

namespace limen::analysis {
namespace {

namespace fs = std::filesystem;

std::string hoverText(const Sweep& sweep, const Cell& cell, const Axis& x, double value) {
  std::string out = sweep.label(cell) + "\n" + sweep.panels[cell.panel].title;
  for (const Axis& column : sweep.varyingColumns)
    if (const auto found = cell.varying.find(column.name); found != cell.varying.end())
      out += "\n" + column.label() + ": " + found->second;
  out += "\n" + x.label() + ": " + formatNumber(value);
  if (&x == &sweep.x && cell.interval) out += " " + bracketed(*cell.interval);
  out += "\n" + sweep.y.label() + ": " + formatNumber(*cell.y);
  if (cell.frontNumber > 0) out += fmt::format("\nno. {} on the Pareto front", cell.frontNumber);
  if (cell.beaten) out += "\nbeaten by another setting";
  return out;
}

/// Of an axis that several panels share, a panel with three marks or more uses this share at least; else each
/// panel has a range of its own.
constexpr double kLeastUse = 0.35;

/// One axis for each panel: the same for all, so that they can be compared, unless they lie too far apart.
std::vector<ChartAxis> makeAxes(const std::vector<std::vector<double>>& values, bool linear) {
  std::vector<double> all;
  std::vector<ChartAxis> own;
  for (const std::vector<double>& panel : values) {
    all.insert(all.end(), panel.begin(), panel.end());
    own.push_back(makeChartAxis(panel, linear));
  }
  const ChartAxis shared = makeChartAxis(all, linear);
  for (size_t panel = 0; panel < values.size(); ++panel)
    if (values[panel].size() >= 3 && own[panel].length() < kLeastUse * shared.length()) return own;
  return std::vector<ChartAxis>(values.size(), shared);
}

// The figure of one x axis: a chart for each panel.
std::vector<std::string> drawFigure(const Sweep& sweep, const Axis& xAxis, bool isCounter,
                                    const std::string& folder, PageCharts& page) {
  std::vector<Chart> charts;
  std::vector<std::vector<double>> xs, ys;
  const VisibleVerdict visible = findVisible(sweep);
  const auto shown =
      std::find_if(visible.measures.begin(), visible.measures.end(),
                   [&](const VisibleVerdict::Measure& measure) { return measure.axis.name == sweep.y.name; });
  for (size_t index = 0; index < sweep.panels.size(); ++index) {
    const Panel& panel = sweep.panels[index];
    Chart chart;
    chart.name = fmt::format("{}_{}", isCounter ? "counter" : "speed", index + 1);
    chart.title = sweep.experiment.title + ", " + panel.title;
    chart.xTitle = xAxis.label();
    chart.yTitle = sweep.y.label();
    chart.yUpsideDown = sweep.y.higherIsBetter();
    chart.hasFront = isCounter ? sweep.counterHasFront() : sweep.noVerdict.empty();
    std::vector<double>&x = xs.emplace_back(), &y = ys.emplace_back();
    std::optional<size_t> cheapest;
    if (shown != visible.measures.end()) {
      cheapest = shown->panels[index].cheapest;
      chart.limit = kVisibleFrom;
      chart.limitLabel = withUnit(kVisibleFrom, sweep.y);
      y.push_back(kVisibleFrom);  // so that the line is in sight even if all marks are on one side of it
    }
    std::vector<std::pair<double, double>> points;
    for (const size_t cellIndex : panel.cells) {
      const Cell& cell = sweep.cells[cellIndex];
      const std::optional<double> at = isCounter ? cell.counter : cell.x;
      if (!at || !cell.y) continue;
      ChartMark mark{*at,
                     *cell.y,
                     isCounter ? std::nullopt : cell.interval,
                     cell.series,
                     false,
                     isCounter ? 0 : cell.frontNumber,
                     cell.run.key,
                     sweep.label(cell),
                     hoverText(sweep, cell, xAxis, *at)};
      if (cellIndex == cheapest) {
        mark.ringed = !isCounter;
        mark.hover += "\ncheapest below " + chart.limitLabel;
      }
      x.push_back(*at);
      if (mark.interval) x.insert(x.end(), {mark.interval->low, mark.interval->high});
      y.push_back(*cell.y);
      points.emplace_back(*at, sweep.y.higherIsBetter() ? -*cell.y : *cell.y);
      chart.marks.push_back(std::move(mark));
    }
    if (chart.hasFront) chart.front = paretoFront(points);
    for (const size_t place : chart.front) chart.marks[place].onFront = true;
    charts.push_back(std::move(chart));
  }
  const std::vector<ChartAxis> xAxes = makeAxes(xs, false), yAxes = makeAxes(ys, sweep.y.higherIsBetter());
  std::vector<std::string> out;
  for (size_t index = 0; index < charts.size(); ++index) {
    const Chart& chart = charts[index];
    const ChartAxis &x = xAxes[index], &y = yAxes[index];
    if (!isCounter) page.ownRanges = page.ownRanges || x.low != xAxes[0].low || y.low != yAxes[0].low;
    out.push_back(chart.marks.empty() ? "" : drawChart(chart, x, y, sweep.series.size(), folder));
    for (const ChartMark& mark : chart.marks)
      page.footUsed = page.footUsed || x.isAtFoot(mark.x) || y.isAtFoot(mark.y);
  }
  return out;
}

/// Into `folder`, which will be `shownFolder`.
ReportResult writeReport(const Sweep& sweep, const std::string& storePath, const fs::path& folder,
                         const fs::path& shownFolder) {
  std::error_code error;
  fs::create_directories(folder / "charts", error);
  if (error)
    throw Error("the folder cannot be made: " + error.message(), folder.string(), "choose another with -o");
  exportTables(sweep, folder.string());
  PageCharts charts;
  charts.speed = drawFigure(sweep, sweep.x, false, (folder / "charts").string(), charts);
  if (sweep.counter)
    charts.counter = drawFigure(sweep, *sweep.counter, true, (folder / "charts").string(), charts);
  const Pictures pictures = choosePictures(sweep, storePath, (folder / "pictures").string());
  const std::string page = (folder / "report.html").string();
  writeFileBytes(page, renderPage(sweep, charts, pictures));

  ReportResult result{(shownFolder / "report.html").string(),
                      sweep.experiment.title,
                      sweep.experiment.hash,
                      sweep.cells.size(),
                      sweep.failed.size(),
                      sweep.missing.size(),
                      0};
  for (const store::Expectation& expectation : sweep.expectations)
    result.brokenExpectations += !expectation.held;
  return result;
}

}  // namespace

void requireComplete(const Sweep& sweep, const std::string& storePath) {
  if (!sweep.isComplete()) {
    const std::string example = !sweep.failed.empty()
                                    ? fmt::format("{} in {} failed: {}", sweep.failed[0].technique,
                                                  sweep.failed[0].scene, sweep.failed[0].error)
                                    : fmt::format("{} ({}) in {} is missing", sweep.missing[0].technique,
                                                  sweep.missing[0].label, sweep.missing[0].scene);
    throw Error(fmt::format("'{}' is not complete: of {} planned runs {} failed and {} are missing ({})",
                            sweep.experiment.title, sweep.planned, sweep.failed.size(), sweep.missing.size(),
                            example),
                storePath, "finish the sweep, or use --force to report on what is there");
  }
  if (sweep.cells.empty())
    throw Error("'" + sweep.experiment.title + "' plans no runs", storePath, "check its descriptor");
}

std::vector<ReportResult> writeReports(const ReportOptions& options) {
  const store::Store store(options.storePath, store::Access::ReadOnly);
  std::vector<Sweep> sweeps;
  for (const store::Experiment& experiment : chooseExperiments(store, options.experiment)) {
    sweeps.push_back(loadSweep(store, experiment));
    if (!options.force) requireComplete(sweeps.back(), options.storePath);
  }
  const StagedFolder staged(options.folder);
  std::vector<ReportResult> results;
  for (const Sweep& sweep : sweeps) {
    fs::path below;
    if (options.ownFolders || sweeps.size() > 1)
      below = slug(sweep.experiment.title) + "_" + sweep.experiment.hash.substr(0, kShortHash);
    results.push_back(
        writeReport(sweep, options.storePath, staged.path() / below, fs::path(options.folder) / below));
  }
  staged.putInPlace();
  return results;
}

}  // namespace limen::analysis
