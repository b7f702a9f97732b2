// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "analysis/output/result.h"

namespace limen::analysis {

/// Facts and tables by name, each table a list of rows, each row an object; then "notes".
nlohmann::json toJson(const Section& section);
/// "command", the facts and tables of the head, "sections" and "notes".
nlohmann::json toJson(const Result& result);

/// All tables of all sections in one: column "table", what identifies the section, then every column that one of
/// them has, empty where a table does not have it.
std::string toCsv(const std::vector<Section>& sections);
/// One table alone.
std::string toCsv(const ResultTable& table);

}  // namespace limen::analysis
