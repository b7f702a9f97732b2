// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cassert>
#include <initializer_list>
#include <unordered_map>

#include "experiments/base/error.h"
#include "experiments/store/rows.h"

namespace limen::store {
namespace {

using Mode = Transaction::Mode;

bool areTexts(const nlohmann::json& object, std::initializer_list<const char*> keys) {
  return object.is_object() && std::all_of(keys.begin(), keys.end(), [&](const char* key) {
           return object.contains(key) && object[key].is_string();
         });
}

bool isList(const nlohmann::json& object, const char* key, bool (nlohmann::json::*isOne)() const noexcept) {
  return object.contains(key) && object[key].is_array() &&
         std::all_of(object[key].begin(), object[key].end(),
                     [&](const nlohmann::json& one) { return (one.*isOne)(); });
}

/// Printed tables, as experiments/published.cpp writes them.
void checkPublished(const Statement& row, int column, const nlohmann::json& tables) {
  if (!tables.is_array()) throw row.damaged(column, "'published' is not an array");
  for (const nlohmann::json& table : tables) {
    if (!areTexts(table, {"title", "source", "device", "note", "unit", "measure"}) ||
        !isList(table, "columns", &nlohmann::json::is_string) ||
        !isList(table, "rows", &nlohmann::json::is_object))
      throw row.damaged(column, "a table of 'published' lacks a member");
    for (const nlohmann::json& line : table["rows"]) {
      const bool whole = areTexts(line, {"name", "relative_to"}) &&
                         isList(line, "runs", &nlohmann::json::is_string) &&
                         isList(line, "passes", &nlohmann::json::is_string) &&
                         isList(line, "values", &nlohmann::json::is_primitive);
      if (!whole) throw row.damaged(column, "a row of 'published' lacks a member");
      for (const nlohmann::json& value : line["values"])
        if (!value.is_null() && !value.is_number())
          throw row.damaged(column, "'values' holds something other than numbers");
      if (line["values"].size() != table["columns"].size())
        throw row.damaged(column, "'published' has " + std::to_string(line["values"].size()) +
                                      " values for " + std::to_string(table["columns"].size()) + " columns");
    }
  }
}

/// What readers of facts take for granted.
void checkFacts(const Statement& row, int column, const nlohmann::json& facts) {
  const auto refuse = [&](const std::string& what) {
    throw row.damaged(column, "'" + what + "' is of another type");
  };
  if (const auto libraries = facts.find("libraries"); libraries != facts.end()) {
    if (!libraries->is_object()) refuse("libraries");
    for (const auto& [name, version] : libraries->items())
      if (!version.is_string()) refuse("libraries." + name);
  }
  if (const auto frontEnd = facts.find("front_end"); frontEnd != facts.end()) {
    if (!frontEnd->is_object()) refuse("front_end");
    for (const char* flag : {"simulated", "lab_ready"})
      if (frontEnd->contains(flag) && !(*frontEnd)[flag].is_boolean()) refuse(flag);
  }
}

// Columns as the SELECTs below list them; the label is the experiment's if the run is read for one.
Run readRun(const Statement& row) {
  Run run;
  run.id = row.integer(0);
  run.key = row.text(1);
  run.device = row.text(2);
  run.status = row.text(3);
  if (run.status != "running" && run.status != "done" && run.status != "failed")
    throw row.damaged(3, "is not a run status");
  run.error = row.text(4);
  run.technique = row.text(5);
  run.scene = row.text(6);
  run.parameters = parseJson(row, 7, JsonIs::Object);
  run.sceneFacts = parseJson(row, 8, JsonIs::Object);
  run.environment = row.isNull(9) ? 0 : row.integer(9);
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

nlohmann::json parseJson(const Statement& row, int column, JsonIs is) {
  const std::string text = row.text(column);
  constexpr int kDeepest = 64;
  int depth = 0, deepest = 0;
  bool quoted = false;
  for (size_t i = 0; i < text.size(); ++i) {
    if (quoted) {
      if (text[i] == '\\')
        ++i;
      else if (text[i] == '"')
        quoted = false;
      continue;
    }
    quoted = text[i] == '"';
    if (text[i] == '[' || text[i] == '{') deepest = std::max(deepest, ++depth);
    if (text[i] == ']' || text[i] == '}') --depth;
  }
  if (deepest > kDeepest) throw row.damaged(column, "is JSON that is nested too deeply");
  nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
  if (json.is_discarded()) throw row.damaged(column, "is not JSON: " + text.substr(0, 60));
  if (is == JsonIs::Object && !json.is_object()) throw row.damaged(column, "is not a JSON object");
  if (is == JsonIs::Array && !json.is_array()) throw row.damaged(column, "is not a JSON array");
  return json;
}

Environment readEnvironment(const Statement& row) {
  nlohmann::json facts = parseJson(row, 2, JsonIs::Object);
  checkFacts(row, 2, facts);
  return {row.text(0), row.truth(1), std::move(facts)};
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
      run.frameTimes.push_back(
          {frameTimes.countingNumber(0), frameTimes.number(1), frameTimes.text(2), frameTimes.integer(3)});
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
    experiment.features = parseJson(row, 6, JsonIs::Array);
    experiment.descriptor = row.text(7);
    experiment.report = parseJson(row, 8, JsonIs::Object);
    for (const auto& [key, value] : experiment.report.items())
      if (key != "published" && !value.is_string()) throw row.damaged(8, "'" + key + "' is not text");
    checkPublished(row, 8, experiment.report.value("published", nlohmann::json::array()));
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
  while (row.step()) out.push_back({row.text(0), row.truth(1), row.text(2)});
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

std::vector<RunState> Store::runStates() const {
  Statement row(database_, "SELECT key, device, status, error, technique, scene, label FROM run ORDER BY id");
  std::vector<RunState> out;
  while (row.step())
    out.push_back(
        {row.text(0), row.text(1), row.text(2), row.text(3), row.text(4), row.text(5), row.text(6)});
  return out;
}

}  // namespace limen::store
