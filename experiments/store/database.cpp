// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/store/database.h"

#include <sqlite3.h>

#include <limits>
#include <new>

#include "experiments/base/error.h"

namespace limen::store {

void throwDatabaseError(sqlite3* database) {
  const char* name = sqlite3_db_filename(database, "main");
  const std::string where = name != nullptr ? name : "";
  const std::string detail = sqlite3_errmsg(database);
  switch (sqlite3_errcode(database) & 0xff) {
    case SQLITE_NOTADB:
      throw Error("is not a result store", where, "give a store that Limen wrote, or a new name");
    case SQLITE_CORRUPT:
      throw Error("the store is damaged (" + detail + ")", where,
                  "recover what is left with 'sqlite3 FILE .recover' and continue in a new store");
    case SQLITE_READONLY:
      throw Error("the store cannot be written", where, "make the file and its folder writable");
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      throw Error("another process has locked the store for more than 30 s", where,
                  "wait for it or stop it, then run the command again");
    case SQLITE_FULL:
      throw Error("the disk is full", where,
                  "free some space and run the command again; finished work is kept");
    case SQLITE_IOERR:
      throw Error("cannot read or write the disk (" + detail + ")", where,
                  "check the disk and its quotas and run the command again; finished work is kept");
    case SQLITE_CANTOPEN:
      throw Error("cannot open the store", where, "check the path and the permissions of its folder");
    default:
      throw Error("the store failed: " + detail, where);
  }
}

Statement::Statement(sqlite3* database, const char* sql) : database_(database) {
  if (sqlite3_prepare_v2(database, sql, -1, &statement_, nullptr) != SQLITE_OK) throwDatabaseError(database);
}

Statement::~Statement() { sqlite3_finalize(statement_); }

void Statement::reset() {
  sqlite3_reset(statement_);
  sqlite3_clear_bindings(statement_);
}

bool Statement::step() {
  const int result = sqlite3_step(statement_);
  if (result == SQLITE_ROW) return true;
  if (result != SQLITE_DONE) throwDatabaseError(database_);
  return false;
}

bool Statement::isNull(int column) const { return sqlite3_column_type(statement_, column) == SQLITE_NULL; }

Error Statement::damaged(int column, const std::string& what) const {
  const auto nameOr = [](const char* name, const char* otherwise) {
    return std::string(name != nullptr ? name : otherwise);
  };
  const std::string file = nameOr(sqlite3_db_filename(database_, "main"), "");
  const std::string table = nameOr(sqlite3_column_table_name(statement_, column), "");
  const std::string name = nameOr(sqlite3_column_origin_name(statement_, column),
                                  nameOr(sqlite3_column_name(statement_, column), "?").c_str());
  // The first column of every list is what tells its rows apart.
  const unsigned char* first = sqlite3_column_text(statement_, 0);
  const std::string key = nameOr(reinterpret_cast<const char*>(first), "NULL");
  constexpr size_t kShown = 40;
  return Error("the store is damaged: " + (table.empty() ? "" : "table " + table + ", ") + "column " + name +
                   ", row with " + nameOr(sqlite3_column_name(statement_, 0), "?") + " " +
                   key.substr(0, kShown) + ": " + what,
               file, "put back a copy, or save what is left with 'sqlite3 FILE .recover'");
}

int64_t Statement::integer(int column) const {
  if (sqlite3_column_type(statement_, column) != SQLITE_INTEGER) throw damaged(column, "is not an integer");
  return sqlite3_column_int64(statement_, column);
}

int Statement::number(int column) const {
  const int64_t value = integer(column);
  if (value < std::numeric_limits<int>::min() || value > std::numeric_limits<int>::max())
    throw damaged(column, std::to_string(value) + " is out of range");
  return static_cast<int>(value);
}

int Statement::countingNumber(int column) const {
  const int value = number(column);
  if (value < 0) throw damaged(column, std::to_string(value) + " is out of range");
  return value;
}

bool Statement::truth(int column) const {
  const int64_t value = integer(column);
  if (value != 0 && value != 1) throw damaged(column, std::to_string(value) + " is neither 0 nor 1");
  return value == 1;
}

double Statement::real(int column) const {
  const int type = sqlite3_column_type(statement_, column);
  if (type != SQLITE_FLOAT && type != SQLITE_INTEGER) throw damaged(column, "is not a number");
  return sqlite3_column_double(statement_, column);
}

std::string Statement::text(int column) const {
  if (sqlite3_column_type(statement_, column) != SQLITE_TEXT) throw damaged(column, "is not text");
  const unsigned char* text = sqlite3_column_text(statement_, column);
  if (text == nullptr) throw std::bad_alloc();
  return {reinterpret_cast<const char*>(text), static_cast<size_t>(sqlite3_column_bytes(statement_, column))};
}

void Statement::bindAt(int index, int64_t value) {
  if (sqlite3_bind_int64(statement_, index, value) != SQLITE_OK) throwDatabaseError(database_);
}

void Statement::bindAt(int index, const std::string& value) {
  const int bytes = static_cast<int>(value.size());
  if (sqlite3_bind_text(statement_, index, value.c_str(), bytes, SQLITE_TRANSIENT) != SQLITE_OK)
    throwDatabaseError(database_);
}

// SQLite stores NaN as NULL and keeps the infinities (the PSNR of equal images).
void Statement::bindAt(int index, const std::optional<double>& value) {
  const int result =
      value ? sqlite3_bind_double(statement_, index, *value) : sqlite3_bind_null(statement_, index);
  if (result != SQLITE_OK) throwDatabaseError(database_);
}

void Statement::bindAt(int index, const std::optional<int64_t>& value) {
  const int result =
      value ? sqlite3_bind_int64(statement_, index, *value) : sqlite3_bind_null(statement_, index);
  if (result != SQLITE_OK) throwDatabaseError(database_);
}

Transaction::Transaction(sqlite3* database, Mode mode) : database_(database) {
  execute(database, mode == Mode::Write ? "BEGIN IMMEDIATE" : "BEGIN");
}

Transaction::~Transaction() {
  if (open_) sqlite3_exec(database_, "ROLLBACK", nullptr, nullptr, nullptr);
}

void Transaction::commit() {
  execute(database_, "COMMIT");
  open_ = false;
}

}  // namespace limen::store
