// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fuzz/damaged_store.h"

#include <sqlite3.h>

#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <vector>

namespace limen::fuzz {
namespace {

using Rows = std::vector<std::vector<std::optional<std::string>>>;

class Database {
 public:
  explicit Database(const std::string& path) { sqlite3_open(path.c_str(), &database_); }
  ~Database() { sqlite3_close(database_); }
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  void execute(const std::string& sql) { sqlite3_exec(database_, sql.c_str(), nullptr, nullptr, nullptr); }
  Rows rows(const std::string& sql) {
    Rows out;
    const auto collect = [](void* to, int count, char** values, char**) {
      auto& row = static_cast<Rows*>(to)->emplace_back();
      for (int i = 0; i < count; ++i)
        row.push_back(values[i] ? std::optional<std::string>(values[i]) : std::nullopt);
      return 0;
    };
    sqlite3_exec(database_, sql.c_str(), collect, &out, nullptr);
    return out;
  }

 private:
  sqlite3* database_ = nullptr;
};

std::string literal(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("''") : c == '\0' ? "" : std::string(1, c);
  return out + "'";
}

/// An SQL expression that a cell is set to; `now` is its value.
std::string oddCell(Random& random, const std::optional<std::string>& now, const std::string& otherCell) {
  static const std::vector<std::string> kValues = {"NULL",
                                                   "-1",
                                                   "0",
                                                   "1",
                                                   "2",
                                                   "-9223372036854775808",
                                                   "9223372036854775807",
                                                   "2147483648",
                                                   "4294967296",
                                                   "1e308",
                                                   "-1e308",
                                                   "9e999",
                                                   "0.5",
                                                   "''",
                                                   "x'00ff'",
                                                   "x''",
                                                   "zeroblob(100000)",
                                                   "'[]'",
                                                   "'{}'",
                                                   "'[null]'",
                                                   "'[1]'",
                                                   "'{\"a\": 1}'",
                                                   "'null'",
                                                   "'true'",
                                                   "'[[]]'",
                                                   "'{\"values\": []}'",
                                                   "'1e999'",
                                                   "'nan'",
                                                   "'\"'",
                                                   "char(27) || '[2J'",
                                                   "char(0)"};
  switch (random.below(4)) {
    case 0:
      return otherCell;
    case 1:  // a change within JSON or text
      if (now && now->size() > 2) return literal(mutateText(random, *now, {*now}));
      [[fallthrough]];
    case 2:
      return literal(oddValue(random));
    default:
      return random.pick(kValues);
  }
}

void changeRows(Random& random, Database& database) {
  const Rows triggers = database.rows("SELECT name FROM sqlite_master WHERE type = 'trigger'");
  database.execute(
      "PRAGMA journal_mode = DELETE; PRAGMA foreign_keys = OFF; PRAGMA ignore_check_constraints = ON; BEGIN");
  for (const auto& trigger : triggers) database.execute("DROP TRIGGER \"" + *trigger[0] + "\"");
  const Rows tables =
      database.rows("SELECT name FROM sqlite_master WHERE type = 'table' AND name NOT LIKE 'sqlite_%'");
  if (tables.empty()) return;
  for (size_t i = random.below(3) + 1; i > 0; --i) {
    const std::string table = *random.pick(tables)[0];
    const Rows ids = database.rows("SELECT rowid FROM \"" + table + "\"");
    const Rows columns = database.rows("SELECT name FROM pragma_table_info('" + table + "')");
    if (ids.empty() || columns.empty()) {
      ++i;  // another one; not all tables are empty
      continue;
    }
    const std::string at = " WHERE rowid = " + *random.pick(ids)[0], column = *random.pick(columns)[0];
    const Rows now = database.rows("SELECT \"" + column + "\" FROM \"" + table + "\"" + at);
    if (random.chance(0.08)) {
      database.execute("DELETE FROM \"" + table + "\"" + (random.chance(0.3) ? "" : at));
    } else if (random.chance(0.03)) {
      database.execute("PRAGMA user_version = " +
                       random.pick(std::vector<std::string>{"-1", "0", "1", "2", "99", "2147483647"}));
    } else if (random.chance(0.03)) {
      database.execute("ALTER TABLE \"" + table + "\" DROP COLUMN \"" + column + "\"");
    } else {
      const std::string other =
          "(SELECT \"" + *random.pick(columns)[0] + "\" FROM \"" + table + "\" ORDER BY rowid LIMIT 1)";
      const std::optional<std::string> value = now.empty() ? std::nullopt : now[0][0];
      database.execute("UPDATE \"" + table + "\" SET \"" + column + "\" = " + oddCell(random, value, other) +
                       (random.chance(0.1) ? "" : at));
    }
  }
  database.execute("COMMIT");
}

}  // namespace

void damageStore(Random& random, const std::string& path) {
  if (random.chance(0.7)) {
    Database database(path);
    changeRows(random, database);
    return;
  }
  std::string bytes;
  {
    std::ifstream stream(path, std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }
  bytes = mutateBytes(random, bytes, {bytes});
  // The header and the pages' own heads are where SQLite reads sizes and addresses.
  if (random.chance(0.5) && bytes.size() > 4096)
    bytes[random.below(bytes.size() / 4096) * 4096 + random.below(120)] =
        static_cast<char>(random.below(256));
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

void mergeJournal(const std::string& path) {
  Database(path).execute("PRAGMA wal_checkpoint(TRUNCATE); PRAGMA journal_mode = DELETE");
}

}  // namespace limen::fuzz
