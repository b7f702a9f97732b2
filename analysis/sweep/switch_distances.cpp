// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/sweep/switch_distances.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "analysis/output/text_output.h"
#include "analysis/sweep/grouping.h"
#include "analysis/sweep/report.h"
#include "experiments/base/error.h"

namespace limen::analysis {
namespace {

using Place = Crossing::Place;

/// "technique.name" -> "name": what a reader calls a parameter.
std::string leafOf(const std::string& path) { return path.substr(path.rfind('.') + 1); }

bool isNamed(const std::string& path, const std::vector<std::string>& names) {
  return std::find(names.begin(), names.end(), leafOf(path)) != names.end() ||
         std::find(names.begin(), names.end(), path) != names.end();
}

double distanceOf(const store::Run& run, const SwitchOptions& options) {
  const std::optional<std::string> text = findParameter(run, options.distance);
  if (!text)
    throw Error("the runs of '" + run.technique + "' have no parameter '" + options.distance + "'",
                "--distance", "name the parameter that is the distance");
  const std::optional<double> value = finiteNumber(*text);
  if (!value || !(*value > 0.0))
    throw Error("the distance of a run is '" + *text + "', not a number above 0", options.storePath);
  return *value;
}

/// Runs of one switch under one condition: view -> distance -> probability.
struct Group {
  std::map<std::string, std::string> all;  ///< every parameter but distance and views
  std::map<std::string, std::map<double, double>> views;
  const store::Run* first = nullptr;
};

std::vector<Group> groupRuns(const std::vector<store::Run>& runs, const SwitchOptions& options) {
  std::map<std::string, Group> groups;
  std::vector<std::string> order;
  for (const store::Run& run : runs) {
    if (run.status != "done") continue;
    const std::optional<double> value = measurementOf(run, options.measurement);
    if (!value)
      throw Error("a run of '" + run.technique + "' (" + run.label + ") has no '" + options.measurement + "'",
                  options.storePath,
                  "sweep a technique that predicts popping, or name another --measurement");
    std::map<std::string, std::string> condition;
    std::string view, key = run.technique + "\n" + run.scene;
    for (const auto& [path, text] : flatParameters(run)) {
      if (isNamed(path, {options.distance})) continue;
      if (isNamed(path, options.views)) {
        view += path + "=" + text + ";";
        continue;
      }
      condition[path] = text;
      key += "\n" + path + "=" + text;
    }
    const auto [entry, fresh] = groups.try_emplace(key, Group{condition, {}, &run});
    if (fresh) order.push_back(key);
    entry->second.views[view][distanceOf(run, options)] = *value;
  }
  std::vector<Group> out;
  for (const std::string& key : order) out.push_back(std::move(groups.at(key)));
  return out;
}

SwitchDistance estimate(const Group& group, const std::set<std::string>& varying,
                        const SwitchOptions& options) {
  SwitchDistance out;
  out.technique = group.first->technique;
  out.scene = group.first->scene;
  for (const auto& [path, text] : group.all)
    if (varying.count(path)) out.condition[path.substr(path.find('.') + 1)] = text;
  for (const auto& [distance, value] : group.views.begin()->second) out.distances.push_back(distance);
  for (const auto& [view, curve] : group.views) {
    std::vector<double> distances, values;
    for (const auto& [distance, value] : curve) {
      distances.push_back(distance);
      values.push_back(value);
    }
    if (distances != out.distances)
      throw Error(fmt::format("the views of a switch ({}) were not all measured at the same distances",
                              group.first->label),
                  options.storePath, "let the sweep multiply views and distances");
    out.views.push_back(std::move(values));
  }
  out.estimate =
      estimateCrossing(out.distances, out.views, options.probability, options.confidence, 2000, options.seed);
  return out;
}

SwitchReport analyse(const store::Store& store, const store::Experiment& experiment,
                     const SwitchOptions& options) {
  SwitchReport report{experiment.title, experiment.hash, options.probability, options.confidence, {}, 0};
  const Names names(store.descriptions(experiment.id));
  report.distanceLabel = names.axis(options.distance).label();
  report.probabilityLabel = names.axis(options.measurement).label();
  const std::vector<store::Run> runs = store.runs(experiment.id);
  const size_t planned = store.plan(experiment.id).size();
  const size_t done = static_cast<size_t>(
      std::count_if(runs.begin(), runs.end(), [](const store::Run& run) { return run.status == "done"; }));
  report.leftOut = planned - std::min(planned, done);
  if (report.leftOut > 0 && !options.force)
    throw Error(fmt::format("'{}' is not complete: {} of {} planned runs are missing or failed",
                            experiment.title, report.leftOut, planned),
                options.storePath, "finish the sweep, or use --force to go on with what is there");
  const std::vector<Group> groups = groupRuns(runs, options);
  if (groups.empty()) throw Error("'" + experiment.title + "' has no finished run", options.storePath);
  std::set<std::string> varying;
  for (const Group& group : groups)
    for (const auto& [path, text] : group.all)
      if (std::any_of(groups.begin(), groups.end(), [&, &path = path, &text = text](const Group& other) {
            const auto found = other.all.find(path);
            return found == other.all.end() || found->second != text;
          }))
        varying.insert(path);
  for (const Group& group : groups) report.switches.push_back(estimate(group, varying, options));
  for (const auto& [path, text] : groups.front().all)
    if (!varying.count(path) && !text.empty() &&
        isNamed(path, {"image.width", "image.height", "display", "display_file"}))
      report.seen[leafOf(path)] = text;
  return report;
}

}  // namespace

std::vector<SwitchReport> findSwitchDistances(const SwitchOptions& options) {
  if (!(options.probability > 0.0 && options.probability < 1.0))
    throw Error(fmt::format("the probability is {}", options.probability), "--probability",
                "give a number between 0 and 1");
  if (!(options.confidence > 0.0 && options.confidence < 1.0))
    throw Error(fmt::format("the confidence is {}", options.confidence), "--confidence",
                "give a number between 0 and 1");
  const store::Store store(options.storePath, store::Access::ReadOnly);
  std::vector<SwitchReport> out;
  for (const store::Experiment& experiment : chooseExperiments(store, options.experiment))
    out.push_back(analyse(store, experiment, options));
  return out;
}

}  // namespace limen::analysis
