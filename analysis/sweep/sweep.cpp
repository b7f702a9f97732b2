// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/sweep/sweep.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "analysis/output/text_output.h"
#include "analysis/sweep/grouping.h"

namespace limen::analysis {
namespace {

constexpr double kNsPerMs = 1e6;

std::optional<double> measured(const store::Run& run, const std::string& name) {
  for (const store::Measurement& measurement : run.measurements)
    if (measurement.name == name) return measurement.value;
  const std::optional<std::string> parameter = findParameter(run, name);
  return parameter ? finiteNumber(*parameter) : std::nullopt;
}

// The counter that most runs have and that differs among them.
std::optional<Axis> chooseCounter(const Sweep& sweep) {
  const std::vector<Cell>& cells = sweep.cells;
  std::vector<std::string> names;
  std::map<std::string, std::set<double>> values;
  std::map<std::string, size_t> count;
  for (const Cell& cell : cells)
    for (const store::Measurement& measurement : cell.run.measurements) {
      if (measurement.kind != "counter" || !measurement.value || measurement.name == sweep.x.name ||
          measurement.name == sweep.y.name)
        continue;
      if (count[measurement.name]++ == 0) names.push_back(measurement.name);
      values[measurement.name].insert(*measurement.value);
    }
  std::optional<std::string> best;
  for (const std::string& name : names)
    if (values[name].size() > 1 && (!best || count[name] > count[*best])) best = name;
  return best ? std::optional(sweep.names.axis(*best)) : std::nullopt;
}

void addTimes(Cell& cell, const std::string& framePass) {
  std::map<std::string, std::vector<double>> ms;
  std::vector<int> rounds;
  for (const store::FrameTime& time : cell.run.frameTimes) {
    ms[time.pass].push_back(static_cast<double>(time.nanoseconds) / kNsPerMs);
    if (time.pass == framePass) rounds.push_back(time.round);
  }
  for (const auto& [pass, values] : ms)
    if (!isWholeFrame(pass)) cell.passes.push_back({pass, summarise(values)});
  // In the order that the frame runs them.
  const auto position = [&](const std::string& name) {
    return std::find_if(cell.run.passes.begin(), cell.run.passes.end(),
                        [&](const store::Pass& pass) { return pass.name == name; });
  };
  std::stable_sort(cell.passes.begin(), cell.passes.end(),
                   [&](const PassTime& a, const PassTime& b) { return position(a.pass) < position(b.pass); });
  const auto frames = ms.find(framePass);
  if (frames == ms.end()) return;
  cell.frame = summarise(frames->second);
  if (frames->second.size() < 2) return;  // a single frame does not say how far times scatter
  cell.interval = bootstrapMedian(frames->second, rounds);
}

// Nothing is better or worse where one of the axes has no better side, or the least error no multiples.
std::string reasonAgainstVerdict(const Sweep& sweep) {
  const store::QuantityRow* x = sweep.names.descriptions().quantity(sweep.x.name);
  if (x == nullptr || x->kind == "error" || x->direction != Direction::LowerIsBetter)
    return "“" + sweep.x.title + "” is neither a time nor a cost";
  const store::QuantityRow* y = sweep.names.descriptions().quantity(sweep.y.name);
  if (y != nullptr && y->kind == "time") return "“" + sweep.y.title + "” is a cost itself, no error";
  if (sweep.y.parameter || sweep.y.direction == Direction::Neither)
    return "of “" + sweep.y.title + "” neither less nor more is better";
  for (const Cell& cell : sweep.cells)
    if (cell.isDrawn() && *cell.y < 0.0 && !sweep.y.higherIsBetter())
      return "“" + sweep.y.title + "” has negative values, so its least has no multiples";
  return {};
}

void findVerdicts(Sweep& sweep) {
  const store::QuantityRow* x = sweep.names.descriptions().quantity(sweep.x.name);
  sweep.xIsTime = x != nullptr && x->kind == "time";
  sweep.noVerdict = reasonAgainstVerdict(sweep);
  if (!sweep.noVerdict.empty()) return;
  for (Panel& panel : sweep.panels) {
    std::vector<size_t> drawn;
    std::vector<std::pair<double, double>> places;
    std::vector<TradeOffPoint> points;
    for (const size_t index : panel.cells) {
      const Cell& cell = sweep.cells[index];
      if (!cell.isDrawn()) continue;
      drawn.push_back(index);
      const double error = sweep.comparableError(cell);
      places.emplace_back(*cell.x, error);
      const MedianInterval bar = cell.interval.value_or(MedianInterval{*cell.x, *cell.x, false});
      points.push_back({*cell.x, bar.low, bar.high, error});
      sweep.exactTimesTaken = sweep.exactTimesTaken || (sweep.xIsTime && !cell.interval);
      panel.noise = std::max(panel.noise, measurementOf(cell.run, sweep.y.name + "_noise").value_or(0.0));
    }
    for (const size_t place : paretoFront(places)) {
      panel.front.push_back(drawn[place]);
      sweep.cells[drawn[place]].frontNumber = static_cast<int>(panel.front.size());
    }
    panel.verdict = weigh(points, panel.noise);
    const auto toCell = [&](size_t& index) { index = drawn[index]; };
    for (TradeOffVerdict::Level& level : panel.verdict.levels) {
      toCell(level.cheapest);
      for (size_t& tie : level.ties) toCell(tie);
    }
    for (size_t& index : panel.verdict.worth) {
      toCell(index);
      sweep.cells[index].worth = true;
    }
    if (panel.verdict.knee) toCell(*panel.verdict.knee);
    for (size_t i = 0; i < drawn.size(); ++i) sweep.cells[drawn[i]].beaten = panel.verdict.beaten[i];
  }
}

// Names are easier to read without the folder that all of them share.
std::string sharedFolder(const std::vector<Cell>& cells) {
  if (cells.empty()) return "";
  std::string shared = cells[0].run.technique;
  shared.resize(shared.rfind('/') + 1);
  for (const Cell& cell : cells)
    while (!cell.run.technique.starts_with(shared)) {
      shared.pop_back();
      shared.resize(shared.rfind('/') + 1);
    }
  return shared;
}

// Done beats failed on the same device; what is neither is missing.
void sortRuns(const store::Store& store, Sweep& sweep) {
  std::set<std::string> settled;
  std::set<std::string> devices;
  for (store::Run& run : store.runs(sweep.experiment.id, true)) {
    if (run.status == "running") continue;
    settled.insert(run.key);
    if (run.status == "failed") {
      sweep.failed.push_back(std::move(run));
      continue;
    }
    devices.insert(run.device);
    Cell cell;
    cell.run = std::move(run);
    sweep.cells.push_back(std::move(cell));
  }
  sweep.severalDevices = devices.size() > 1;
  const std::vector<store::PlanEntry> plan = store.plan(sweep.experiment.id);
  sweep.planned = plan.size();
  for (const store::PlanEntry& entry : plan)
    if (settled.count(entry.key) == 0) sweep.missing.push_back(entry);
}

}  // namespace

bool isWholeFrame(const std::string& pass) { return pass == "frame" || pass == "wall" || pass == "cpu"; }

bool Sweep::counterHasFront() const {
  const store::QuantityRow* row = names.descriptions().quantity(y.name);
  return y.direction != Direction::Neither && (row == nullptr || row->kind != "time");
}

double Sweep::comparableError(const Cell& cell) const {
  if (!y.higherIsBetter()) return *cell.y;
  // Decibels of an amplitude become that amplitude again; of a share, its inverse.
  if (y.unit == "dB") return std::pow(10.0, -*cell.y / 20.0);
  return *cell.y > 0.0 ? 1.0 / *cell.y : INFINITY;
}

std::string Sweep::label(const Cell& cell) const {
  const std::string& settings = cell.settings;
  std::string out =
      seriesName == "technique" ? series[cell.series] : cell.run.technique.substr(seriesPrefix.size());
  return settings.empty() ? out : out + ", " + settings;
}

std::vector<PassRow> passRows(const Cell& cell) {
  std::vector<PassRow> out;
  for (const store::Pass& pass : cell.run.passes) out.push_back({&cell, pass.name, pass.bytesHeld, {}});
  for (const PassTime& time : cell.passes) {
    auto row =
        std::find_if(out.begin(), out.end(), [&](const PassRow& one) { return one.pass == time.pass; });
    if (row == out.end()) row = out.insert(out.end(), {&cell, time.pass, 0, {}});
    row->ms = time.ms;
  }
  return out;
}

Sweep loadSweep(const store::Store& store, const store::Experiment& experiment) {
  Sweep sweep;
  sweep.experiment = experiment;
  sweep.expectations = store.expectations(experiment.id);
  sortRuns(store, sweep);

  std::set<int64_t> environmentIds;
  for (const Cell& cell : sweep.cells)
    if (cell.run.environment != 0) environmentIds.insert(cell.run.environment);
  for (const int64_t id : environmentIds) {
    sweep.environments.push_back(store.environment(id));
    sweep.software = sweep.software || sweep.environments.back().software;
  }

  const nlohmann::json& report = experiment.report;
  sweep.names = Names(store.descriptions(experiment.id));
  sweep.x = sweep.names.axis(report.value("x", "gpu_ms"), sweep.software);
  sweep.y = sweep.names.axis(report.value("y", "rmse"), sweep.software);
  sweep.counter = chooseCounter(sweep);
  sweep.seriesName = report.value("series", "technique");
  sweep.panelName = report.value("panels", "scene");

  std::vector<const store::Run*> runs;
  for (const Cell& cell : sweep.cells) runs.push_back(&cell.run);
  for (const store::Run& run : sweep.failed) runs.push_back(&run);
  const Grouping grouping(runs, sweep.names);
  std::vector<std::string> panels;
  for (size_t index = 0; index < sweep.cells.size(); ++index) {
    Cell& cell = sweep.cells[index];
    addTimes(cell, sweep.x.pass);
    cell.x = measured(cell.run, sweep.x.name);
    if (!cell.x && cell.frame) cell.x = cell.frame->median;
    // Where other settings were planned but are not there, the plan's own label tells them apart.
    cell.settings = grouping.settings(cell.run);
    if (cell.settings.empty()) cell.settings = cell.run.label;
    cell.y = measured(cell.run, sweep.y.name);
    if (sweep.counter) cell.counter = measured(cell.run, sweep.counter->name);
    cell.varying = grouping.varying(cell.run);
    cell.series = indexIn(sweep.series, grouping.group(cell.run, sweep.seriesName));
    // Times of two machines are not compared, so each device has its panels.
    std::string panel = grouping.group(cell.run, sweep.panelName);
    if (sweep.severalDevices) panel += " — " + cell.run.device;
    cell.panel = indexIn(panels, panel);
    if (cell.panel == sweep.panels.size()) sweep.panels.push_back({panel, {}, {}, {}, 0.0});
    sweep.panels[cell.panel].cells.push_back(index);
  }
  sweep.seriesPrefix = sharedFolder(sweep.cells);
  if (sweep.seriesName == "technique")
    for (std::string& name : sweep.series) name.erase(0, sweep.seriesPrefix.size());
  sweep.varyingColumns = grouping.columns();
  findVerdicts(sweep);
  return sweep;
}

}  // namespace limen::analysis
