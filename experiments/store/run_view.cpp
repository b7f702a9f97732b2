// SPDX-License-Identifier: BSD-3-Clause
// View `runs`: one wide row for each run, for pandas, R, DuckDB and whoever reads SQLite.
#include <sqlite3.h>

#include <set>
#include <string>
#include <vector>

#include "experiments/store/rows.h"

namespace limen::store {
namespace {

/// SQLite allows 2,000 columns; beyond this many, parameters stay in their JSON.
constexpr size_t kMostColumns = 1500;

std::string quoted(const std::string& text, char mark) {
  std::string out(1, mark);
  for (const char c : text) out += c == mark ? std::string(2, mark) : std::string(1, c);
  return out + mark;
}

/// Columns by their names, which SQLite compares without case.
class Columns {
 public:
  explicit Columns(std::string sql) : sql_(std::move(sql)) {}
  void take(const std::string& name) { taken_.insert(lowered(name)); }
  /// Later columns of a name that is taken get `prefix` before it; nothing if that is taken too.
  void add(const std::string& name, const std::string& prefix, const std::string& expression) {
    for (const std::string& candidate : {name, prefix + name}) {
      if (!taken_.insert(lowered(candidate)).second) continue;
      sql_ += ",\n  " + expression + " AS " + quoted(candidate, '"');
      return;
    }
  }
  size_t size() const { return taken_.size(); }
  const std::string& sql() const { return sql_; }

 private:
  static std::string lowered(std::string text) {
    for (char& c : text)
      if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return text;
  }
  std::string sql_;
  std::set<std::string> taken_;
};

/// JSON paths cannot quote these.
bool fitsPath(const std::string& path) { return path.find('"') == std::string::npos; }

}  // namespace

void writeRunView(sqlite3* database) {
  Columns columns(
      "CREATE VIEW runs AS SELECT r.id AS run, r.key, r.device, e.software, r.status, r.error, r.technique, "
      "r.scene, r.label, r.started, r.finished, json_extract(r.scene_facts, '$.product_hash') AS "
      "product_hash");
  for (const char* name : {"run", "key", "device", "software", "status", "error", "technique", "scene",
                           "label", "started", "finished", "product_hash"})
    columns.take(name);
  std::set<std::string> wide;
  {
    Statement parameter(database,
                        "SELECT DISTINCT subject, path FROM parameter WHERE subject <> 'metric' "
                        "ORDER BY subject DESC, path");
    while (parameter.step())
      if (fitsPath(parameter.text(1))) wide.insert(parameter.text(0) + "." + parameter.text(1));
    Statement quantity(database, "SELECT DISTINCT name FROM quantity ORDER BY name");
    std::vector<std::string> names;
    while (quantity.step()) names.push_back(quantity.text(0));
    if (columns.size() + wide.size() + names.size() <= kMostColumns)
      for (const std::string& name : wide) {
        const size_t dot = name.find('.');
        columns.add(name, "parameter.",
                    "json_extract(r.parameters, " +
                        quoted("$." + name.substr(0, dot) + ".\"" + name.substr(dot + 1) + "\"", '\'') + ")");
      }
    for (const std::string& name : names)
      columns.add(name, "measured.",
                  "CAST((SELECT value FROM measurement WHERE run = r.id AND name = " + quoted(name, '\'') +
                      ") AS REAL)");
  }
  execute(database, "DROP VIEW IF EXISTS runs");
  execute(database,
          (columns.sql() + "\nFROM run r LEFT JOIN environment e ON e.id = r.environment WHERE r.status <> "
                           "'running'")
              .c_str());
}

}  // namespace limen::store
