// SPDX-License-Identifier: BSD-3-Clause
#include <cassert>
#include <unordered_map>

#include "experiments/base/error.h"
#include "experiments/store/rows.h"

namespace limen::store {
namespace {

using Mode = Transaction::Mode;

Environment readEnvironment(const Statement& row) {
  return {row.text(0), row.integer(1) != 0, parseJson(row.text(2))};
}

// Columns as the SELECTs below list them; the label is the experiment's if the run is read for one.
Run readRun(const Statement& row) {
  Run run;
  run.id = row.integer(0);
  run.key = row.text(1);
  run.device = row.text(2);
  run.status = row.text(3);
  run.error = row.text(4);
  run.technique = row.text(5);
  run.scene = row.text(6);
  run.parameters = parseJson(row.text(7));
  run.sceneFacts = parseJson(row.text(8));
  run.environment = row.integer(9);
  run.owner = row.text(10);
  run.started = row.text(11);
  run.finished = row.text(12);
  run.label = row.text(13);
  return run;
}

constexpr const char* kSelectAll =
    "SELECT r.id, r.key, r.device, r.status, r.error, r.technique, r.scene, r.parameters, r.scene_facts, "
    "r.environment, r.owner, r.started, r.finished, r.label FROM run r ORDER BY r.id";
constexpr const char* kSelectOfExperiment =
    "SELECT r.id, r.key, r.device, r.status, r.error, r.technique, r.scene, r.parameters, r.scene_facts, "
    "r.environment, r.owner, r.started, r.finished, e.label FROM experiment_run e JOIN run r ON r.key = "
    "e.key "
    "WHERE e.experiment = ? ORDER BY e.position, r.device";

}  // namespace

nlohmann::json parseJson(const std::string& text) {
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::exception&) {
    throw Error("the store holds text that is not JSON: " + text.substr(0, 60));
  }
}

Run readRunById(sqlite3* database, int64_t id) {
  Statement row(
      database,
      "SELECT r.id, r.key, r.device, r.status, r.error, r.technique, r.scene, r.parameters, r.scene_facts, "
      "r.environment, r.owner, r.started, r.finished, r.label FROM run r WHERE r.id = ?");
  row.bind(id).step();
  return readRun(row);
}

void readDetails(sqlite3* database, std::vector<Run>& runs, bool withFrameTimes) {
  Statement measurements(database,
                         "SELECT name, value, unit, kind FROM measurement WHERE run = ? ORDER BY rowid");
  Statement passes(database, "SELECT name, bytes_held FROM pass WHERE run = ? ORDER BY position");
  Statement artefacts(database, "SELECT kind, path, sha256 FROM artefact WHERE run = ? ORDER BY rowid");
  Statement frameTimes(
      database, "SELECT frame, round, pass, nanoseconds FROM frame_time WHERE run = ? ORDER BY frame, rowid");
  for (Run& run : runs) {
    measurements.bind(run.id);
    while (measurements.step()) {
      std::optional<double> value;
      if (!measurements.isNull(1)) value = measurements.real(1);
      run.measurements.push_back({measurements.text(0), value, measurements.text(2), measurements.text(3)});
    }
    passes.bind(run.id);
    while (passes.step()) run.passes.push_back({passes.text(0), passes.integer(1)});
    artefacts.bind(run.id);
    while (artefacts.step())
      run.artefacts.push_back({artefacts.text(0), artefacts.text(1), artefacts.text(2)});
    if (!withFrameTimes) continue;
    frameTimes.bind(run.id);
    while (frameTimes.step())
      run.frameTimes.push_back({static_cast<int>(frameTimes.integer(0)),
                                static_cast<int>(frameTimes.integer(1)), frameTimes.text(2),
                                frameTimes.integer(3)});
  }
}

bool Store::isDone(const std::string& key, const std::string& device) const {
  return Statement(database_, "SELECT 1 FROM run WHERE key = ? AND device = ? AND status = 'done'")
      .bind(key, device)
      .step();
}

std::vector<Experiment> Store::experiments() const {
  Statement row(
      database_,
      "SELECT id, hash, path, title, question, source, features, descriptor, report FROM experiment "
      "ORDER BY id");
  std::vector<Experiment> out;
  while (row.step()) {
    Experiment experiment;
    experiment.id = row.integer(0);
    experiment.hash = row.text(1);
    experiment.path = row.text(2);
    experiment.title = row.text(3);
    experiment.question = row.text(4);
    experiment.source = row.text(5);
    experiment.features = parseJson(row.text(6));
    experiment.descriptor = row.text(7);
    experiment.report = parseJson(row.text(8));
    out.push_back(std::move(experiment));
  }
  return out;
}

std::vector<PlanEntry> Store::plan(int64_t experiment) const {
  Statement row(
      database_,
      "SELECT key, technique, scene, label FROM experiment_run WHERE experiment = ? ORDER BY position");
  row.bind(experiment);
  std::vector<PlanEntry> out;
  while (row.step()) out.push_back({row.text(0), row.text(1), row.text(2), row.text(3)});
  return out;
}

std::vector<Expectation> Store::expectations(int64_t experiment) const {
  Statement row(database_,
                "SELECT text, held, detail FROM expectation WHERE experiment = ? ORDER BY position");
  row.bind(experiment);
  std::vector<Expectation> out;
  while (row.step()) out.push_back({row.text(0), row.integer(1) != 0, row.text(2)});
  return out;
}

std::vector<Environment> Store::environments() const {
  Statement row(database_, "SELECT device, software, facts FROM environment ORDER BY id");
  std::vector<Environment> out;
  while (row.step()) out.push_back(readEnvironment(row));
  return out;
}

Environment Store::environment(int64_t id) const {
  Statement row(database_, "SELECT device, software, facts FROM environment WHERE id = ?");
  if (!row.bind(id).step()) throw Error("no environment " + std::to_string(id), path_);
  return readEnvironment(row);
}

std::vector<Run> Store::runs(int64_t experiment, bool withFrameTimes) const {
  Transaction snapshot(database_, Mode::Read);
  std::vector<Run> out;
  Statement row(database_, kSelectOfExperiment);
  row.bind(experiment);
  while (row.step()) out.push_back(readRun(row));
  readDetails(database_, out, withFrameTimes);
  return out;
}

std::vector<Run> Store::allRuns(bool withFrameTimes) const {
  Transaction snapshot(database_, Mode::Read);
  std::vector<Run> out;
  Statement row(database_, kSelectAll);
  while (row.step()) out.push_back(readRun(row));
  readDetails(database_, out, withFrameTimes);
  return out;
}

}  // namespace limen::store
