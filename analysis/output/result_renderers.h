// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "analysis/output/result.h"

namespace limen::analysis {

/// A cell of a column as people read it; "-" for a number that is missing.
std::string cellText(const Column& column, const ResultCell& cell);

/// What a terminal shows.
std::string toText(const Result& result);
std::string toText(const Section& section);

/// Facts and tables by name, each table a list of rows, each row an object; then "notes".
nlohmann::json toJson(const Section& section);
/// "command", the facts and tables of the head, "sections" and "notes".
nlohmann::json toJson(const Result& result);

/// The same as text on one line, with its end.
std::string jsonLine(const Result& result);

/// All tables of all sections in one: column "table", what identifies the section, then every column that one
/// of them has, empty where a table does not have it.
std::string toCsv(const std::vector<Section>& sections);
/// One table alone.
std::string toCsv(const ResultTable& table);

struct HtmlOptions {
  std::string attributes;  ///< of the <table>: " class=\"front\""
  std::string caption;     ///< HTML; "": none
  bool rowHeads = false;   ///< the first column heads each row
  bool sortable = false;   ///< headings are buttons, numbers stand beside their cells in full
  std::function<std::string(size_t row)> ofRow;  ///< attributes of a row
  std::string box = "<div class=\"scroll\">";    ///< around the table
};

/// What people see of a table; "" for one without rows.
std::string toHtml(const ResultTable& table, const HtmlOptions& options = {});

}  // namespace limen::analysis
