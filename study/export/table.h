// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace limen::study {

/// A column and its entry in the data dictionary.
struct Column {
  std::string name;                           ///< snake_case
  std::string description;                    ///< one sentence
  std::string unit;                           ///< "" for none
  std::map<std::string, std::string> levels;  ///< what coded values mean; empty: free values
};

/// Rows of text; nullopt is a value that does not exist.
struct Table {
  std::vector<Column> columns;
  std::vector<std::vector<std::optional<std::string>>> rows;

  /// Programmer error if the row has another length.
  void add(std::vector<std::optional<std::string>> row);
};

/// RFC 4180, "\n" line ends; missing values are empty.
std::string toCsv(const Table& table);
/// As in BIDS: missing values are "n/a"; tabs and line ends within values become blanks.
std::string toTsv(const Table& table);
/// BIDS sidecar: {"column": {"Description", "Units", "Levels"}}.
nlohmann::json dictionary(const std::vector<Column>& columns);

/// Shortest text that reads back to the same number.
std::string toText(double value);

}  // namespace limen::study
