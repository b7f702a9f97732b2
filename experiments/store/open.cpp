// SPDX-License-Identifier: BSD-3-Clause
#include <fcntl.h>
#include <sqlite3.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <iterator>
#include <system_error>
#include <thread>
#include <utility>

#include "experiments/base/error.h"
#include "experiments/base/input_files.h"
#include "experiments/base/printable.h"
#include "experiments/store/database.h"

namespace limen::embedded {
extern const char* const kStoreSchema;
extern const char* const kStudySchema;
extern const char* const kDescriptionSchema;
}  // namespace limen::embedded

namespace limen::store {
namespace {

namespace fs = std::filesystem;

constexpr int kBusyTimeoutMs = 30'000;      // many sweeps write to one file; a write takes milliseconds
constexpr int kApplicationId = 0x4c494d4e;  // "LIMN": tells a store from other SQLite files

// migrations[i] leads from schema version i to i + 1. A new store is the result of all of them, so a migrated
// store and a new one cannot differ.
const char* const kMigrations[] = {embedded::kStoreSchema, embedded::kStudySchema,
                                   embedded::kDescriptionSchema};
constexpr int kSchemaVersion = static_cast<int>(std::size(kMigrations));

struct Closer {
  sqlite3* database = nullptr;
  ~Closer() { sqlite3_close(database); }
  sqlite3* release() { return std::exchange(database, nullptr); }
};

int64_t pragma(sqlite3* database, const char* sql) {
  Statement statement(database, sql);
  return statement.step() ? statement.integer(0) : 0;
}

void executeScript(sqlite3* database, const std::string& sql) {
  if (sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK)
    throwDatabaseError(database);
}

// Turning the log on needs exclusive access for a moment, and SQLite does not always wait for that.
void turnOnWriteAheadLog(sqlite3* database) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(kBusyTimeoutMs);
  while (true) {
    const int result = sqlite3_exec(database, "PRAGMA journal_mode = WAL", nullptr, nullptr, nullptr);
    if (result == SQLITE_OK) return;
    if (result != SQLITE_BUSY || std::chrono::steady_clock::now() > deadline) throwDatabaseError(database);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

bool isEmpty(sqlite3* database) {
  return pragma(database, "PRAGMA application_id") == 0 && pragma(database, "PRAGMA user_version") == 0 &&
         pragma(database, "SELECT count(*) FROM sqlite_schema") == 0;
}

void requireStore(sqlite3* database, const std::string& path) {
  if (pragma(database, "PRAGMA application_id") != kApplicationId)
    throw Error("is an SQLite file but not a result store", path,
                "give a store that Limen wrote, or a new name");
  const int64_t version = pragma(database, "PRAGMA user_version");
  if (version < 0)
    throw Error("the store is damaged: user_version is " + std::to_string(version), path,
                "put back a copy, or save what is left with 'sqlite3 FILE .recover'");
  if (version > kSchemaVersion)
    throw Error("the store has schema version " + std::to_string(version) + ", this program knows " +
                    std::to_string(kSchemaVersion),
                path, "use the newer Limen that wrote it");
}

void migrate(sqlite3* database, const std::string& path) {
  Transaction transaction(database, Transaction::Mode::Write);
  if (isEmpty(database)) executeScript(database, "PRAGMA application_id = " + std::to_string(kApplicationId));
  requireStore(database, path);
  for (int64_t version = pragma(database, "PRAGMA user_version"); version < kSchemaVersion; ++version) {
    executeScript(database, kMigrations[version]);
    executeScript(database, "PRAGMA user_version = " + std::to_string(version + 1));
  }
  transaction.commit();
}

// A store in a read-only folder (a CD, an archive) can only be read as an immutable file: SQLite has no place
// there for the log's shared index. That is safe only if there is no pending log beside it.
std::string readOnlyUri(const std::string& path) {
  std::string uri = "file:";
  for (const char c : fs::absolute(path).string()) {
    if (c == '%' || c == '?' || c == '#') {
      const char* digits = "0123456789abcdef";
      uri += {'%', digits[(c >> 4) & 15], digits[c & 15]};
    } else {
      uri += c;
    }
  }
  const fs::path folder = fs::absolute(path).parent_path();
  const std::string log = path + "-wal";
  const bool untouched = access(folder.c_str(), W_OK) != 0 && (!fs::exists(log) || fs::is_empty(log));
  return uri + (untouched ? "?mode=ro&immutable=1" : "?mode=ro");
}

// What tells who took part is for the owner alone; the log and its index take the rights of the store from
// then on.
void hideFromOthers(const std::string& path) {
  for (const char* suffix : {"", "-wal", "-shm", "-journal"}) {
    struct stat facts {};
    const std::string file = path + suffix;
    if (stat(file.c_str(), &facts) == 0 && (facts.st_mode & 077) != 0) chmod(file.c_str(), 0600);
  }
}

bool holdsSessions(sqlite3* database) {
  return pragma(database, "SELECT count(*) FROM sqlite_schema WHERE name = 'session'") > 0 &&
         pragma(database, "SELECT count(*) FROM session") > 0;
}

void prepareFolder(const std::string& path) {
  const fs::path folder = fs::absolute(path).parent_path();
  std::error_code error;
  fs::create_directories(folder, error);
  if (!fs::is_directory(folder))
    throw Error("the folder '" + folder.string() + "' cannot be created", path, "choose another path");
  if (access(folder.c_str(), W_OK) != 0)
    throw Error("the folder '" + folder.string() + "' cannot be written", path,
                "choose another folder or change its permissions");
}

}  // namespace

bool isUnwritten(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::is_regular_file(status)) return status.type() == fs::file_type::not_found;
  // A process that was killed while it turned on the log left a journal, which only a writer may roll back.
  for (const int flags : {SQLITE_OPEN_READONLY, SQLITE_OPEN_READWRITE}) {
    Closer closer;
    const std::string name = flags == SQLITE_OPEN_READONLY ? readOnlyUri(path) : path;
    const int more = flags == SQLITE_OPEN_READONLY ? SQLITE_OPEN_URI : 0;
    if (sqlite3_open_v2(name.c_str(), &closer.database, flags | more, nullptr) != SQLITE_OK) return false;
    sqlite3_busy_timeout(closer.database, kBusyTimeoutMs);
    try {
      return isEmpty(closer.database);
    } catch (const Error&) {
      // What else it is will be said when it is opened.
      if ((sqlite3_errcode(closer.database) & 0xff) != SQLITE_READONLY) return false;
    }
  }
  return false;
}

sqlite3* openDatabase(const std::string& path, bool readOnly, int oldest, Contents contents) {
  // SQLite keeps a database of this name in memory, and drops it at the end.
  if (path.empty() || path == ":memory:")
    throw Error("'" + path + "' is not a file", "store", "name a file; what is measured would be lost");
  requirePlainName(path);
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (code && status.type() != fs::file_type::not_found)
    throw Error("the store cannot be opened: " + code.message(), path, "check the path");
  if (fs::is_directory(status)) throw Error("is a folder, not a result store", path, "name a file in it");
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw Error("is not a file but a pipe or a device", path, "name a file");
  if (readOnly && !fs::exists(status))
    throw Error("no such result store", path, "check the path; limen sweep and limen study create stores");
  if (!readOnly) prepareFolder(path);
  protectInput(path);
  if (contents == Contents::Sessions && !readOnly) {
    // Made by SQLite, the file would be open to others for a moment.
    const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (file >= 0) close(file);
  }

  const std::string name = readOnly ? readOnlyUri(path) : path;
  const int flags =
      readOnly ? SQLITE_OPEN_READONLY | SQLITE_OPEN_URI : SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  Closer closer;
  if (sqlite3_open_v2(name.c_str(), &closer.database, flags, nullptr) != SQLITE_OK)
    throw Error("cannot open the store", path, "check the path and the file's permissions");
  sqlite3* database = closer.database;
  sqlite3_busy_timeout(database, kBusyTimeoutMs);
  execute(database, "PRAGMA foreign_keys = ON");
  if (readOnly) {
    if (isEmpty(database))
      throw Error("is empty: nothing was ever stored in it", path, "run a sweep or a study into it first");
    requireStore(database, path);
    if (pragma(database, "PRAGMA user_version") < oldest)
      throw Error("the store was written by an older Limen and holds no studies", path,
                  "name a store that a study wrote");
    return closer.release();
  }
  if (!isEmpty(database)) requireStore(database, path);
  if (contents == Contents::Sessions || holdsSessions(database)) hideFromOthers(path);
  turnOnWriteAheadLog(database);
  // With the log, a commit survives the death of the process even at NORMAL; FULL also syncs it, so that it
  // survives a power cut. What sweeps write for each run is not synced at once but in batches.
  execute(database, "PRAGMA synchronous = FULL");
  migrate(database, path);
  return closer.release();
}

}  // namespace limen::store
