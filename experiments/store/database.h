// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "experiments/base/error.h"

struct sqlite3;
struct sqlite3_stmt;

namespace limen::store {

/// Throws Error for the connection's last error, in the user's terms (full disk, read-only file, not a store
/// ...).
[[noreturn]] void throwDatabaseError(sqlite3* database);

/// A prepared statement; every failure is an Error.
class Statement {
 public:
  Statement(sqlite3* database, const char* sql);
  ~Statement();
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  template <class... Values>
  Statement& bind(const Values&... values) {
    reset();
    int index = 0;
    (bindAt(++index, values), ...);
    return *this;
  }
  /// True while there is a row.
  bool step();
  /// Runs a statement that gives no rows.
  void execute() {
    while (step()) {
    }
  }

  bool isNull(int column) const;
  /// Values of the present row. A store may come from anybody or a failing disk: whatever is of another type,
  /// or absent, throws damaged().
  int64_t integer(int column) const;
  int number(int column) const;          ///< that fits an int
  int countingNumber(int column) const;  ///< from 0
  bool truth(int column) const;          ///< 0 or 1
  double real(int column) const;
  std::string text(int column) const;
  /// The error for a value that cannot be: names file, table, column and row.
  Error damaged(int column, const std::string& what) const;

 private:
  void reset();
  void bindAt(int index, int64_t value);
  void bindAt(int index, int value) { bindAt(index, static_cast<int64_t>(value)); }
  void bindAt(int index, bool value) { bindAt(index, static_cast<int64_t>(value)); }
  void bindAt(int index, const std::string& value);
  void bindAt(int index, const std::optional<double>& value);
  void bindAt(int index, const std::optional<int64_t>& value);

  sqlite3* database_;
  sqlite3_stmt* statement_ = nullptr;
};

template <class... Values>
void execute(sqlite3* database, const char* sql, const Values&... values) {
  Statement(database, sql).bind(values...).execute();
}

/// Rolled back unless committed.
class Transaction {
 public:
  /// Write takes the write lock immediately, so that nothing read inside can change before it is written;
  /// Read sees one snapshot of the file throughout.
  enum class Mode { Read, Write };
  Transaction(sqlite3* database, Mode mode);
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit();

 private:
  sqlite3* database_;
  bool open_ = true;
};

/// What a store is opened to write. One that holds sessions can be read by its owner alone (mode 0600) from
/// then on.
enum class Contents { Runs, Sessions };

/// Opens, checks that the file is a store of a known schema, migrates. A file opened for reading keeps its
/// schema, which must be at least version `oldest`: 1 has sweeps, 2 also studies. An empty file is a new
/// store.
sqlite3* openDatabase(const std::string& path, bool readOnly, int oldest = 1,
                      Contents contents = Contents::Runs);

}  // namespace limen::store
