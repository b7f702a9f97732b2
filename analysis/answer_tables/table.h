// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace limen::analysis {

/// A table of text with named columns, read from CSV (RFC 4180) or TSV. Numbers have a decimal point,
/// whatever the locale. Whatever is wrong throws one Error with file, line and column.
class Table {
 public:
  /// Reads a file; `separator` 0: a tab if the first line holds one, else a comma. A byte order mark and CRLF
  /// are taken; blank lines are skipped. Throws Error: no such file, empty, no rows, a header twice, a row
  /// that has more or fewer fields than the header, a quote that does not close.
  static Table read(const std::string& path, char separator = 0);
  static Table parse(const std::string& text, const std::string& name, char separator = 0);

  const std::vector<std::string>& header() const { return header_; }
  size_t rows() const { return rows_.size(); }
  /// Index of a column; throws Error with the nearest name. `option` says who asks.
  size_t column(const std::string& name, const std::string& option = {}) const;
  std::vector<size_t> columns(const std::vector<std::string>& names, const std::string& option) const;
  std::optional<size_t> optionalColumn(const std::string& name,
                                       const std::string& option) const;  ///< "": none

  const std::string& text(size_t row, size_t column) const { return rows_[row].fields[column]; }
  double number(size_t row, size_t column) const;  ///< finite
  int64_t count(size_t row, size_t column) const;  ///< whole, not negative; "90.0" too
  /// "FILE:LINE, column 'NAME'" of a field, for messages of one's own.
  std::string place(size_t row, size_t column) const;
  std::string place(size_t row) const;
  const std::string& name() const { return name_; }  ///< of the file

  /// These rows alone, which keep their places.
  Table only(const std::vector<size_t>& rows) const;

 private:
  struct Row {
    size_t line;
    std::vector<std::string> fields;
  };
  std::string name_;
  std::vector<std::string> header_;
  std::vector<Row> rows_;
};

}  // namespace limen::analysis
