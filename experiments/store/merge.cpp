// SPDX-License-Identifier: BSD-3-Clause
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <system_error>
#include <unordered_set>

#include "experiments/base/claim_owner.h"
#include "experiments/base/error.h"
#include "experiments/base/folder_lock.h"
#include "experiments/base/hash.h"
#include "experiments/base/part_file.h"
#include "experiments/store/rows.h"

namespace limen::store {
namespace {

namespace fs = std::filesystem;
using Mode = Transaction::Mode;

constexpr size_t kRunsPerTransaction = 64;  // other writers wait for at most this many

fs::path folderOf(const std::string& storePath) { return fs::absolute(storePath).parent_path(); }

// A store may come from anyone: a path that leaves its folder is refused.
void requireInside(const fs::path& path, const std::string& store) {
  const bool escapes =
      std::any_of(path.begin(), path.end(), [](const fs::path& part) { return part == ".."; });
  if (path.is_absolute() || path.empty() || escapes)
    throw Error("artefact path '" + path.string() + "' leaves the store's folder", store,
                "give it a path below the folder of the store");
}

// `path` itself, or with the run's key in its name if another file has that path already; failing that with
// the content's hash, for the same run on another device.
fs::path freePath(const fs::path& folder, const Artefact& artefact, const std::string& key) {
  const fs::path path = artefact.path;
  const std::string stem = path.stem().string(), extension = path.extension().string();
  for (const std::string& infix : {std::string(), "." + key.substr(0, 16),
                                   "." + key.substr(0, 16) + "." + artefact.sha256.substr(0, 16)}) {
    const fs::path candidate = path.parent_path() / (stem + infix + extension);
    if (!fs::exists(folder / candidate) || sha256File((folder / candidate).string()) == artefact.sha256)
      return candidate;
  }
  throw Error("a changed file is in the way of artefact '" + artefact.path + "'", folder.string(),
              "move the file away and merge again");
}

// Takes one artefact file along and returns its path in the new folder. A copy is moved into place when
// complete, so that a killed merge leaves no incomplete file under a valid name. Folders with a new name of a
// file, which are not on the disk yet, are added to `changed`.
std::string takeArtefact(const Artefact& artefact, const std::string& key, const std::string& from,
                         const std::string& to, Store::Files files, std::set<std::string>& changed) {
  requireInside(artefact.path, from);
  const fs::path source = folderOf(from) / artefact.path;
  if (!fs::exists(source))
    throw Error("the artefact file '" + source.string() + "' is missing", from,
                "restore it beside the store, or delete its row of table artefact");
  if (sha256File(source.string()) != artefact.sha256)
    throw Error("the artefact file '" + source.string() + "' is not the one the run wrote (SHA-256 differs)",
                from, "restore the right file, or delete its row of table artefact");
  const fs::path target = freePath(folderOf(to), artefact, key), full = folderOf(to) / target;
  if (fs::exists(full)) return target.string();
  std::error_code error;
  fs::create_directories(full.parent_path(), error);
  if (error)
    throw Error("the folder cannot be made: " + error.message(), full.parent_path().string(),
                "check rights and space");
  if (files == Store::Files::Shared &&
      linkat(AT_FDCWD, source.c_str(), AT_FDCWD, full.c_str(), AT_SYMLINK_FOLLOW) == 0) {
    changed.insert(full.parent_path().string());
    return target.string();
  }
  PartFile part(full.string());
  std::ifstream in(source, std::ios::binary);
  std::vector<char> buffer(size_t{1} << 20);
  while (in.read(buffer.data(), static_cast<std::streamsize>(buffer.size())) || in.gcount() > 0)
    part.write({buffer.data(), static_cast<size_t>(in.gcount())});
  part.close();
  if (sha256File(part.path()) != artefact.sha256)
    throw Error("the artefact file '" + source.string() + "' cannot be read", from, "look at the disk");
  part.putInPlace();
  return target.string();
}

// Whether a row of the other store replaces (or joins) what this store has for the same key and device.
bool isWanted(sqlite3* database, const Run& other) {
  if (other.status == "running") return false;
  Statement find(database, "SELECT status, owner FROM run WHERE key = ? AND device = ?");
  if (!find.bind(other.key, other.device).step()) return true;
  const std::string status = find.text(0);
  if (status == "running") {
    const OwnerState state = stateOfOwner(find.text(1));
    return state == OwnerState::Died || state == OwnerState::Ended;
  }
  return status == "failed" && other.status == "done";
}

void insertRun(sqlite3* database, const Run& run, const std::optional<int64_t>& environment) {
  execute(database, "DELETE FROM run WHERE key = ? AND device = ?", run.key, run.device);
  execute(database,
          "INSERT INTO run (key, device, status, error, technique, scene, label, parameters, scene_facts, "
          "environment, "
          "started, finished) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
          run.key, run.device, run.status, run.error, run.technique, run.scene, run.label,
          run.parameters.dump(), run.sceneFacts.dump(), environment, run.started, run.finished);
  Statement find(database, "SELECT id FROM run WHERE key = ? AND device = ?");
  find.bind(run.key, run.device).step();
  writeDetails(database, find.integer(0), run);
}

// Shards of one sweep evaluate the same expectations on their own runs: met means met in all of them.
std::vector<Expectation> joinExpectations(std::vector<Expectation> ours,
                                          const std::vector<Expectation>& theirs) {
  for (const Expectation& expectation : theirs) {
    const auto same = std::find_if(ours.begin(), ours.end(),
                                   [&](const Expectation& own) { return own.text == expectation.text; });
    if (same == ours.end()) {
      ours.push_back(expectation);
    } else if (!expectation.held) {
      const std::string separator = same->held || same->detail.empty() ? "" : "; ";
      same->detail = (same->held ? "" : same->detail) + separator + expectation.detail;
      same->held = false;
    }
  }
  return ours;
}

}  // namespace

int64_t Store::merge(const Store& other, Files files) {
  if (fs::equivalent(path_, other.path_))
    throw Error("cannot be merged into itself", path_, "name another store");
  // What is planned here is read, joined and written again: two merges at once would lose one of both.
  const FolderLock lock(folderOf(path_).string());
  // Sessions are joined on export: their numbers of participants would clash here.
  Statement tables(other.database_, "SELECT 1 FROM sqlite_schema WHERE name = 'session'");
  if (tables.step()) {
    Statement sessions(other.database_, "SELECT count(*) FROM session");
    sessions.step();
    if (sessions.integer(0) > 0)
      throw Error(
          "holds " + std::to_string(sessions.integer(0)) + " session(s) of studies, which are not merged",
          other.path_, "keep this store and pass both to the analysis");
  }

  const std::vector<Experiment> known = experiments();
  for (const Experiment& experiment : other.experiments()) {
    const auto same = std::find_if(known.begin(), known.end(),
                                   [&](const Experiment& own) { return own.hash == experiment.hash; });
    std::vector<PlanEntry> joined = same == known.end() ? std::vector<PlanEntry>() : plan(same->id);
    const Descriptions ours = same == known.end() ? Descriptions() : readDescriptions(database_, same->id);
    std::unordered_set<std::string> keys;
    for (const PlanEntry& own : joined) keys.insert(own.key);
    const size_t before = joined.size();
    for (const PlanEntry& entry : other.plan(experiment.id))
      if (keys.insert(entry.key).second) joined.push_back(entry);
    const Descriptions theirs = readDescriptions(other.database_, experiment.id);
    const std::vector<Expectation> judged = other.expectations(experiment.id);
    // Nothing is written where nothing is new: a thousand parts of one sweep are merged one after another.
    int64_t id = same == known.end() ? 0 : same->id;
    if (id == 0 || joined.size() > before || !(joinDescriptions(ours, theirs) == ours))
      id = putExperiment(same == known.end() ? experiment : *same, joined, joinDescriptions(ours, theirs));
    if (!judged.empty()) putExpectations(id, joinExpectations(expectations(id), judged));
  }

  std::vector<Run> candidates;
  {
    Statement row(other.database_, "SELECT id, key, device, status FROM run ORDER BY id");
    while (row.step()) {
      Run run;
      run.id = row.integer(0);
      run.key = row.text(1);
      run.device = row.text(2);
      run.status = row.text(3);
      if (isWanted(database_, run)) candidates.push_back(std::move(run));
    }
  }

  std::map<int64_t, std::optional<int64_t>> environmentIds{{0, std::nullopt}};
  int64_t added = 0;
  for (size_t begin = 0; begin < candidates.size(); begin += kRunsPerTransaction) {
    const size_t end = std::min(candidates.size(), begin + kRunsPerTransaction);
    std::vector<Run> chunk;
    for (size_t i = begin; i < end; ++i) chunk.push_back(readRunById(other.database_, candidates[i].id));
    readDetails(other.database_, chunk, true);
    std::set<std::string> changedFolders;
    for (Run& run : chunk) {
      if (environmentIds.count(run.environment) == 0)
        environmentIds[run.environment] = putEnvironment(other.environment(run.environment));
      for (Artefact& artefact : run.artefacts)
        artefact.path = takeArtefact(artefact, run.key, other.path_, path_, files, changedFolders);
    }
    for (const std::string& folder : changedFolders) syncPath(folder);
    Transaction transaction(database_, Mode::Write);
    for (const Run& run : chunk) {
      if (!isWanted(database_, run)) continue;  // finished here by another process meanwhile
      insertRun(database_, run, environmentIds.at(run.environment));
      ++added;
    }
    transaction.commit();
  }
  return added;
}

}  // namespace limen::store
