// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/sweep/sweep.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "analysis/sweep/grouping.h"
#include "analysis/sweep/trade_off.h"

namespace limen::analysis {
namespace {

constexpr double kNsPerMs = 1e6;

std::optional<double> measured(const store::Run& run, const std::string& name) {
  for (const store::Measurement& measurement : run.measurements)
    if (measurement.name == name) return measurement.value;
  const std::optional<std::string> parameter = findParameter(run, name);
  if (!parameter) return std::nullopt;
  char* end = nullptr;
  const double value = std::strtod(parameter->c_str(), &end);
  return *end == '\0' && !parameter->empty() ? std::optional(value) : std::nullopt;
}

std::string passOf(const std::string& name) {
  if (name == "gpu_ms") return "frame";
  if (name == "cpu_ms") return "cpu";
  return name == "wall_ms" ? "wall" : "";
}

// "micro_occluders_per_px" -> "micro occluders per px"; a unit that stands in brackets is not said twice.
std::string titleOf(const std::string& name, const std::string& unit, bool software) {
  std::string words = name;
  if (name == "gpu_ms")
    words = software ? "frame time on the CPU" : "GPU time";
  else if (name == "cpu_ms")
    words = "CPU time";
  else if (name == "wall_ms")
    words = "wall time";
  else if (unit == "ms" && words.size() > 3 && words.ends_with("_ms"))
    words.resize(words.size() - 3);
  if (name == "rmse" || name == "psnr" || name == "ssim" || name == "jnd" || name == "mse" || name == "flip")
    std::transform(words.begin(), words.end(), words.begin(),
                   [](unsigned char c) { return std::toupper(c); });
  std::replace(words.begin(), words.end(), '_', ' ');
  return unit.empty() ? words : words + " (" + unit + ")";
}

Axis makeAxis(const std::string& name, const std::vector<Cell>& cells, bool software) {
  Axis axis{name, "", "", passOf(name), false};
  for (const Cell& cell : cells)
    for (const store::Measurement& measurement : cell.run.measurements)
      if (measurement.name == name) axis.unit = measurement.unit;
  axis.title = titleOf(name, axis.unit, software);
  // The store does not say which way a metric points; of those in use these two families grow with quality.
  axis.higherIsBetter = name.find("psnr") != std::string::npos || name.find("ssim") != std::string::npos;
  return axis;
}

// The counter that most runs have and that differs among them.
std::optional<Axis> chooseCounter(const std::vector<Cell>& cells, const std::string& x, const std::string& y,
                                  bool software) {
  std::vector<std::string> names;
  std::map<std::string, std::set<double>> values;
  std::map<std::string, size_t> count;
  for (const Cell& cell : cells)
    for (const store::Measurement& measurement : cell.run.measurements) {
      if (measurement.kind != "counter" || !measurement.value || measurement.name == x ||
          measurement.name == y)
        continue;
      if (count[measurement.name]++ == 0) names.push_back(measurement.name);
      values[measurement.name].insert(*measurement.value);
    }
  std::optional<std::string> best;
  for (const std::string& name : names)
    if (values[name].size() > 1 && (!best || count[name] > count[*best])) best = name;
  return best ? std::optional(makeAxis(*best, cells, software)) : std::nullopt;
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
  cell.interval = bootstrapMedian(frames->second, rounds);
}

size_t indexOf(std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<size_t>(found - names.begin());
  names.push_back(name);
  return names.size() - 1;
}

void findFronts(Sweep& sweep) {
  for (Panel& panel : sweep.panels) {
    std::vector<size_t> drawn;
    std::vector<std::pair<double, double>> points;
    for (const size_t index : panel.cells) {
      const Cell& cell = sweep.cells[index];
      if (!cell.isDrawn()) continue;
      drawn.push_back(index);
      points.emplace_back(*cell.x, sweep.y.higherIsBetter ? -*cell.y : *cell.y);
    }
    for (const size_t place : paretoFront(points)) {
      panel.front.push_back(drawn[place]);
      sweep.cells[drawn[place]].frontNumber = static_cast<int>(panel.front.size());
    }
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

std::string Sweep::label(const Cell& cell) const {
  const std::string& settings = cell.run.label;
  std::string out =
      seriesName == "technique" ? series[cell.series] : cell.run.technique.substr(seriesPrefix.size());
  return settings.empty() ? out : out + ", " + settings;
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
  sweep.x = makeAxis(report.value("x", "gpu_ms"), sweep.cells, sweep.software);
  sweep.y = makeAxis(report.value("y", "rmse"), sweep.cells, sweep.software);
  sweep.counter = chooseCounter(sweep.cells, sweep.x.name, sweep.y.name, sweep.software);
  sweep.seriesName = report.value("series", "technique");
  sweep.panelName = report.value("panels", "scene");

  std::vector<const store::Run*> runs;
  for (const Cell& cell : sweep.cells) runs.push_back(&cell.run);
  const Grouping grouping(runs);
  std::vector<std::string> panels;
  for (size_t index = 0; index < sweep.cells.size(); ++index) {
    Cell& cell = sweep.cells[index];
    addTimes(cell, sweep.x.pass);
    cell.x = measured(cell.run, sweep.x.name);
    if (!cell.x && cell.frame) cell.x = cell.frame->median;
    cell.y = measured(cell.run, sweep.y.name);
    if (sweep.counter) cell.counter = measured(cell.run, sweep.counter->name);
    cell.varying = grouping.varying(cell.run);
    cell.series = indexOf(sweep.series, grouping.group(cell.run, sweep.seriesName));
    // Times of two machines are not compared, so each device has its panels.
    std::string panel = grouping.group(cell.run, sweep.panelName);
    if (sweep.severalDevices) panel += " — " + cell.run.device;
    cell.panel = indexOf(panels, panel);
    if (cell.panel == sweep.panels.size()) sweep.panels.push_back({panel, {}, {}});
    sweep.panels[cell.panel].cells.push_back(index);
  }
  sweep.seriesPrefix = sharedFolder(sweep.cells);
  if (sweep.seriesName == "technique")
    for (std::string& name : sweep.series) name.erase(0, sweep.seriesPrefix.size());
  sweep.varyingColumns = grouping.columns();
  findFronts(sweep);
  return sweep;
}

}  // namespace limen::analysis
