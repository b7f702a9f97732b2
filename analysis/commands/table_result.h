// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "analysis/commands/study_input.h"
#include "analysis/data/table.h"
#include "experiments/base/hash.h"

namespace limen::analysis {

/// printStudyResult() for a table: opens with the file, its rows and its SHA-256.
template <class Result>
void printTableResult(const StudyInput& input, const Table& table, const Result& result,
                      const std::string& name) {
  const std::string& file = input.choice.store;
  if (!input.csv.empty()) writeFileBytes(input.csv, toCsv(result));
  const std::string hash = sha256File(file);
  if (input.asJson) {
    printJson({{"file", file}, {"sha256", hash}, {"rows", table.rows()}, {name, toJson(result)}});
  } else {
    std::printf("%s, %zu rows, SHA-256 %s\n%s", file.c_str(), table.rows(), hash.substr(0, 12).c_str(),
                toText(result).c_str());
  }
}

/// Throws Error unless a confidence level lies between 0 and 1, both excluded, and samples of a bootstrap are
/// 100 to 1,000,000, or 0 if `orNone`.
void checkIntervals(double level, size_t samples, bool orNone);

}  // namespace limen::analysis
