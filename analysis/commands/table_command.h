// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "analysis/commands/study_input.h"
#include "analysis/data/answer_columns.h"
#include "analysis/groups/table_input.h"

namespace limen::analysis {

/// For commands that take a store or a table: addStudyInput() and --where.
void addTableInput(CLI::App& command, StudyInput& input, std::vector<std::string>& where);
/// --outcome, --k, --n.
void addAnswerColumns(CLI::App& command, AnswerColumns& columns);

/// printStudyResult() of a table.
template <class Result>
void printTableResult(const StudyInput& input, const TableInput& table, const Result& result,
                      const std::string& name) {
  if (!input.csv.empty()) writeFileBytes(input.csv, toCsv(result));
  if (input.asJson) {
    nlohmann::json out = headJson(table);
    out[name] = toJson(result);
    printJson(out);
  } else {
    std::printf("%s%s", headText(table).c_str(), toText(result).c_str());
  }
}

}  // namespace limen::analysis
