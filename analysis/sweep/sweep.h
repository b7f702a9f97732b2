// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "analysis/statistics/summary.h"
#include "analysis/sweep/names.h"
#include "analysis/sweep/trade_off.h"
#include "experiments/store/store.h"

namespace limen::analysis {

/// Times of one pass over the frames of a run.
struct PassTime {
  std::string pass;
  Summary ms;
};

/// A finished run with what the report needs of it.
struct Cell {
  store::Run run;
  size_t series = 0, panel = 0;            ///< indices into Sweep
  std::optional<double> x, y, counter;     ///< values on the axes
  std::optional<Summary> frame;            ///< of the x axis' pass, milliseconds
  std::optional<MedianInterval> interval;  ///< of the median of that
  std::vector<PassTime> passes;
  std::string settings;  ///< "budget radial, rim 25": what tells it from others of its technique
  std::map<std::string, std::string> varying;  ///< column -> value, of what varies among the runs
  int frontNumber = 0;                         ///< place on the panel's Pareto front, from 1; 0: not on it
  bool worth = false;                          ///< its cost, by the rules of trade_off.h
  bool beaten = false;                         ///< by another of its panel, as far as the sweep can tell
  bool isDrawn() const { return x && y; }
};

struct Panel {
  std::string title;
  std::vector<size_t> cells, front;  ///< indices into Sweep::cells; the front from fast to exact
  TradeOffVerdict verdict;           ///< of the cells that are drawn, by index into Sweep::cells
  double noise = 0.0;                ///< errors that differ by no more are not told apart
};

/// One experiment of a store, sorted for a report.
struct Sweep {
  store::Experiment experiment;
  std::vector<store::Expectation> expectations;
  std::vector<store::Environment> environments;  ///< those that its runs were measured in
  std::vector<Cell> cells;
  std::vector<store::Run> failed;
  std::vector<store::PlanEntry> missing;  ///< neither done nor failed: never run, or given up
  size_t planned = 0;
  Names names;  ///< what names mean in this experiment
  Axis x, y;
  std::optional<Axis> counter;  ///< machine-independent cost, if the runs have one
  std::string seriesName, panelName;
  std::vector<std::string> series;  ///< as a reader sees them: without `seriesPrefix`
  std::string seriesPrefix;         ///< folder that all techniques share ("soft_shadows/")
  std::vector<Panel> panels;
  std::vector<Axis> varyingColumns;
  std::string noVerdict;         ///< why nothing is called better: part of a sentence; "": it can be
  bool xIsTime = false;          ///< else a cost, or none
  bool exactTimesTaken = false;  ///< drawn times without an interval are compared as if they were exact
  bool software = false;         ///< at least one run was timed on a software renderer
  bool severalDevices = false;

  /// Whether the chart against the counter has a front: y is better on one side and no time itself.
  bool counterHasFront() const;
  bool isComplete() const { return missing.empty() && failed.empty(); }
  /// The error as a verdict weighs it: a positive number of which less is better and ratios mean something.
  double comparableError(const Cell& cell) const;
  /// "pcss, samples 8": what tells this cell from the others of its panel.
  std::string label(const Cell& cell) const;
};

/// A pass of a run: what it held, and its times where it was timed.
struct PassRow {
  const Cell* cell;
  std::string pass;
  int64_t bytesHeld = 0;
  std::optional<Summary> ms;
};
/// Those that the run names, then those that were timed alone, which held nothing of their own.
std::vector<PassRow> passRows(const Cell& cell);

/// Reads an experiment from a store and computes statistics and Pareto fronts.
Sweep loadSweep(const store::Store& store, const store::Experiment& experiment);

/// The frame's own times, as opposed to those of a pass within it.
bool isWholeFrame(const std::string& pass);

}  // namespace limen::analysis
