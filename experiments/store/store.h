// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "experiments/store/descriptions.h"

struct sqlite3;

namespace limen::store {

struct Measurement {
  std::string name;
  std::optional<double> value;  ///< nullopt: not a number
  std::string unit;
  std::string kind;  ///< time, error, counter or fact
};

struct FrameTime {
  int frame = 0, round = 0;
  std::string pass;
  int64_t nanoseconds = 0;
};

struct Pass {
  std::string name;
  int64_t bytesHeld = 0;
};

struct Artefact {
  std::string kind, path, sha256;  ///< path relative to the store's folder
};

/// Where and with what a run was measured.
struct Environment {
  std::string device;     ///< GL renderer and version
  bool software = false;  ///< a CPU renders in place of a GPU
  nlohmann::json facts = nlohmann::json::object();
};

struct Experiment {
  int64_t id = 0;
  std::string hash, path, title, question, source, descriptor;
  nlohmann::json features = nlohmann::json::array(), report = nlohmann::json::object();
};

/// A place in an experiment's plan.
struct PlanEntry {
  std::string key, technique, scene, label;
};

struct Expectation {
  std::string text;
  bool held = false;
  std::string detail;
};

/// Everything a finished (or failed) run leaves behind.
struct Run {
  int64_t id = 0;
  std::string key, device, status, error, technique, scene, label;
  nlohmann::json parameters = nlohmann::json::object(), sceneFacts = nlohmann::json::object();
  int64_t environment = 0;  ///< row id; 0: none yet
  std::string owner, started, finished;
  std::vector<Measurement> measurements;
  std::vector<FrameTime> frameTimes;
  std::vector<Pass> passes;
  std::vector<Artefact> artefacts;
};

/// How a run stands, without what it measured.
struct RunState {
  std::string key, device, status, error, technique, scene, label;
};

enum class Access { ReadOnly, ReadWrite };

/// One SQLite file (schema.sql). Write-ahead log, foreign keys on, waits for other writers. Every member
/// throws Error: not a store, a newer schema, a full disk.
class Store {
 public:
  /// ReadWrite creates a missing file and migrates an old one, which only adds tables; ReadOnly refuses a
  /// missing file and reads an old one as it is.
  Store(const std::string& path, Access access);
  ~Store();
  Store(const Store&) = delete;
  Store& operator=(const Store&) = delete;

  const std::string& path() const { return path_; }

  /// Inserts the experiment, its plan and the descriptions of its names, or finds the one with the same hash
  /// (whose plan and descriptions are replaced). Returns its id.
  int64_t putExperiment(const Experiment& experiment, const std::vector<PlanEntry>& plan,
                        const Descriptions& descriptions = {});
  /// Returns the row id of an environment with the same facts, inserted if necessary.
  int64_t putEnvironment(const Environment& environment);
  void putExpectations(int64_t experiment, const std::vector<Expectation>& expectations);

  enum class Claim { Claimed, AlreadyDone, HeldByOther };
  /// Claims (run.key, run.device) for this process in one transaction: inserts a 'running' row, or takes over
  /// a failed one or one whose owner is dead (stateOfOwner(): same host and no such process, or its job of
  /// Slurm over or started anew; or, where nobody knows, older than `staleSeconds`).
  Claim claim(const Run& run, double staleSeconds = 3600.0);
  /// How many processes died while they held a run that this process holds now. One that was stopped by a
  /// signal or an error has given it back; one whose whole job ended is not counted: nothing says that the
  /// run did it.
  int deaths(const std::string& key, const std::string& device) const;
  /// Whether a run failed with diedTwice().
  bool hasDiedTwice(const std::string& key, const std::string& device) const;
  /// Error of a run that is given up, `what` being what it was about.
  static std::string diedTwice(const std::string& what);
  /// Ends a claimed run in one transaction: status, error, measurements, frame times, passes, artefacts.
  /// From then on it survives the death of this process, and after sync() also a power cut.
  void finish(const Run& run);
  /// Waits until everything finished is on disk.
  void sync();
  /// Releases unfinished claims of this process.
  void releaseClaims();

  bool isDone(const std::string& key, const std::string& device) const;
  std::vector<Experiment> experiments() const;
  std::vector<PlanEntry> plan(int64_t experiment) const;
  /// What the names of an experiment mean: as written with its plan, and formerQuantity() for whatever else
  /// its runs have (in a store of schema 2: for everything).
  Descriptions descriptions(int64_t experiment) const;
  std::vector<Expectation> expectations(int64_t experiment) const;
  std::vector<Environment> environments() const;
  Environment environment(int64_t id) const;
  /// Runs of an experiment in plan order with their measurements, passes and artefacts; frame times only on
  /// request. A plan entry without a row is absent.
  std::vector<Run> runs(int64_t experiment, bool withFrameTimes = false) const;
  std::vector<Run> allRuns(bool withFrameTimes = false) const;
  std::vector<RunState> runStates() const;

  /// What becomes of artefact files: copies, or further names of the same files where the file system allows.
  enum class Files { Copied, Shared };
  /// Copies what this store lacks from `other`: finished runs win over failed ones; artefact files are taken
  /// along. Returns the number of runs added.
  int64_t merge(const Store& other, Files files = Files::Copied);

 private:
  std::string path_;
  sqlite3* database_ = nullptr;
};

/// Whether the file is still to become a store: it is missing or empty, or an SQLite file without tables, as
/// a process leaves it that was killed while it made one.
bool isUnwritten(const std::string& path);

}  // namespace limen::store
