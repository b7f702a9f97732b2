// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/store/store.h"

#include <sqlite3.h>

#include <cassert>

#include "experiments/base/claim_owner.h"
#include "experiments/base/clock.h"
#include "experiments/base/error.h"
#include "experiments/base/hash.h"
#include "experiments/store/rows.h"

namespace limen::store {
namespace {

using Mode = Transaction::Mode;

std::optional<int64_t> orNull(int64_t id) { return id == 0 ? std::nullopt : std::optional<int64_t>(id); }

// Text from a driver may hold bytes that are not UTF-8; they must not stop a sweep.
std::string dump(const nlohmann::json& json) {
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

constexpr const char* kDied = "a process died while it held this run";
constexpr const char* kDiedTwice = "its process died twice while ";

/// Commits within its life survive the death of the process but not a power cut, and do not wait for the
/// disk, which takes milliseconds each time.
class WithoutSync {
 public:
  explicit WithoutSync(sqlite3* database) : database_(database) {
    execute(database_, "PRAGMA synchronous = NORMAL");
  }
  ~WithoutSync() { sqlite3_exec(database_, "PRAGMA synchronous = FULL", nullptr, nullptr, nullptr); }
  WithoutSync(const WithoutSync&) = delete;
  WithoutSync& operator=(const WithoutSync&) = delete;

 private:
  sqlite3* database_;
};

}  // namespace

Store::Store(const std::string& path, Access access)
    : path_(path), database_(openDatabase(path, access == Access::ReadOnly)) {}

Store::~Store() { sqlite3_close(database_); }

int64_t Store::putExperiment(const Experiment& experiment, const std::vector<PlanEntry>& plan,
                             const Descriptions& descriptions) {
  Transaction transaction(database_, Mode::Write);
  execute(
      database_,
      "INSERT INTO experiment (hash, path, title, question, source, features, descriptor, report, created) "
      "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?) ON CONFLICT (hash) DO UPDATE SET path = excluded.path",
      experiment.hash, experiment.path, experiment.title, experiment.question, experiment.source,
      dump(experiment.features), experiment.descriptor, dump(experiment.report), utcNow());
  Statement find(database_, "SELECT id FROM experiment WHERE hash = ?");
  find.bind(experiment.hash).step();
  const int64_t id = find.integer(0);
  execute(database_, "DELETE FROM experiment_run WHERE experiment = ?", id);
  Statement insert(database_,
                   "INSERT INTO experiment_run (experiment, key, position, technique, scene, label) "
                   "VALUES (?, ?, ?, ?, ?, ?)");
  int position = 0;
  for (const PlanEntry& entry : plan)
    insert.bind(id, entry.key, position++, entry.technique, entry.scene, entry.label).execute();
  writeDescriptions(database_, id, descriptions);
  writeRunView(database_);
  transaction.commit();
  return id;
}

int64_t Store::putEnvironment(const Environment& environment) {
  const std::string facts = dump(environment.facts);
  const std::string hash =
      sha256(environment.device + "\n" + (environment.software ? "1" : "0") + "\n" + facts);
  Transaction transaction(database_, Mode::Write);
  execute(
      database_,
      "INSERT INTO environment (hash, device, software, facts) VALUES (?, ?, ?, ?) ON CONFLICT DO NOTHING",
      hash, environment.device, environment.software, facts);
  Statement find(database_, "SELECT id FROM environment WHERE hash = ?");
  find.bind(hash).step();
  const int64_t id = find.integer(0);
  transaction.commit();
  return id;
}

void Store::putExpectations(int64_t experiment, const std::vector<Expectation>& expectations) {
  Transaction transaction(database_, Mode::Write);
  execute(database_, "DELETE FROM expectation WHERE experiment = ?", experiment);
  Statement insert(
      database_, "INSERT INTO expectation (experiment, position, text, held, detail) VALUES (?, ?, ?, ?, ?)");
  int position = 0;
  for (const Expectation& expectation : expectations)
    insert.bind(experiment, position++, expectation.text, expectation.held, expectation.detail).execute();
  transaction.commit();
}

Store::Claim Store::claim(const Run& run, double staleSeconds) {
  const WithoutSync withoutSync(database_);
  const std::string self = claimOwner();
  Transaction transaction(database_, Mode::Write);
  Statement find(
      database_,
      "SELECT id, status, owner, (julianday('now') - julianday(started)) * 86400.0, error FROM run "
      "WHERE key = ? AND device = ?");
  std::string error;  // of a row that is 'running': how many held it before
  if (find.bind(run.key, run.device).step()) {
    const std::string status = find.text(1), owner = find.text(2);
    if (status == "done") return Claim::AlreadyDone;
    if (status == "running" && owner != self) {
      const OwnerState state = stateOfOwner(owner);
      const bool stale = find.isNull(3) || find.real(3) > staleSeconds;
      if (state == OwnerState::Alive || (state == OwnerState::Unknown && !stale)) return Claim::HeldByOther;
      error = find.text(4);
      if (state != OwnerState::Ended) error = error.empty() ? kDied : kDiedTwice;
    }
    // What a failed run left behind is deleted with its row.
    execute(database_, "DELETE FROM run WHERE id = ?", find.integer(0));
  }
  execute(database_,
          "INSERT INTO run (key, device, status, technique, scene, label, parameters, scene_facts, "
          "environment, owner, "
          "started, error) VALUES (?, ?, 'running', ?, ?, ?, ?, ?, ?, ?, ?, ?)",
          run.key, run.device, run.technique, run.scene, run.label, dump(run.parameters),
          dump(run.sceneFacts), orNull(run.environment), self, utcNow(), error);
  transaction.commit();
  return Claim::Claimed;
}

int Store::deaths(const std::string& key, const std::string& device) const {
  Statement find(database_,
                 "SELECT error FROM run WHERE key = ? AND device = ? AND status = 'running' AND owner = ?");
  if (!find.bind(key, device, claimOwner()).step()) return 0;
  const std::string error = find.text(0);
  return error.empty() ? 0 : error == kDied ? 1 : 2;
}

bool Store::hasDiedTwice(const std::string& key, const std::string& device) const {
  Statement find(database_, "SELECT error FROM run WHERE key = ? AND device = ? AND status = 'failed'");
  return find.bind(key, device).step() && find.text(0).starts_with(kDiedTwice);
}

std::string Store::diedTwice(const std::string& what) { return kDiedTwice + what; }

void Store::finish(const Run& run) {
  assert(run.status == "done" || run.status == "failed");
  const WithoutSync withoutSync(database_);
  Transaction transaction(database_, Mode::Write);
  Statement find(database_,
                 "SELECT id FROM run WHERE key = ? AND device = ? AND status = 'running' AND owner = ?");
  if (!find.bind(run.key, run.device, claimOwner()).step())
    throw Error("run " + run.key + " is no longer held by this process", path_,
                "another process took it over; start the sweep again, finished runs are kept");
  const int64_t id = find.integer(0);
  execute(database_,
          "UPDATE run SET status = ?, error = ?, scene_facts = ?, environment = coalesce(?, environment), "
          "owner = '', finished = ? WHERE id = ?",
          run.status, run.error, dump(run.sceneFacts), orNull(run.environment), utcNow(), id);
  writeDetails(database_, id, run);
  transaction.commit();
}

void Store::sync() {
  // A commit of any page syncs the whole log.
  Transaction transaction(database_, Mode::Write);
  execute(database_, "UPDATE run SET owner = owner WHERE id = (SELECT max(id) FROM run)");
  transaction.commit();
}

void Store::releaseClaims() {
  Transaction transaction(database_, Mode::Write);
  execute(database_, "DELETE FROM run WHERE status = 'running' AND owner = ?", claimOwner());
  transaction.commit();
}

void writeDetails(sqlite3* database, int64_t id, const Run& run) {
  for (const char* sql : {"DELETE FROM measurement WHERE run = ?", "DELETE FROM frame_time WHERE run = ?",
                          "DELETE FROM pass WHERE run = ?", "DELETE FROM artefact WHERE run = ?"})
    execute(database, sql, id);
  Statement measurement(database,
                        "INSERT INTO measurement (run, name, value, unit, kind) VALUES (?, ?, ?, ?, ?)");
  for (const Measurement& m : run.measurements)
    measurement.bind(id, m.name, m.value, m.unit, m.kind).execute();
  Statement frameTime(database,
                      "INSERT INTO frame_time (run, frame, round, pass, nanoseconds) VALUES (?, ?, ?, ?, ?)");
  for (const FrameTime& t : run.frameTimes)
    frameTime.bind(id, t.frame, t.round, t.pass, t.nanoseconds).execute();
  Statement pass(database, "INSERT INTO pass (run, position, name, bytes_held) VALUES (?, ?, ?, ?)");
  int position = 0;
  for (const Pass& p : run.passes) pass.bind(id, position++, p.name, p.bytesHeld).execute();
  Statement artefact(database, "INSERT INTO artefact (run, kind, path, sha256) VALUES (?, ?, ?, ?)");
  for (const Artefact& a : run.artefacts) artefact.bind(id, a.kind, a.path, a.sha256).execute();
}

}  // namespace limen::store
