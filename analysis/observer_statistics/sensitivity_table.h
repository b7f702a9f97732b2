// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "analysis/answer_tables/answer_columns.h"
#include "analysis/observer_statistics/sensitivity.h"

namespace limen::analysis {

/// Columns of a table for signal detection, as typed. Without `subject` each combination of `by` is a row of
/// the result and means are over all rows; with it each combination is a part, with a row for each subject
/// and means over subjects.
struct SensitivityColumns {
  std::vector<std::string> by;
  std::string subject;
  std::string task = "yesno";  ///< "yesno", "2afc", "mafc:M"
  std::string signal;          ///< yes/no trials, beside answers.outcome: 1 if there was something to see
  std::string hits, signals, falseAlarms, noises;  ///< yes/no counts
  AnswerColumns answers;                           ///< alternatives
  RateCorrection correction = RateCorrection::kLogLinear;
};

/// "loglinear" or "none"; Error otherwise.
RateCorrection readRateCorrection(const std::string& text);

/// Rows of the same names are added up. Throws Error with row and column as the readers of columns do, and
/// for columns that do not fit the task.
std::vector<PartSensitivity> tableSensitivity(const Table& table, const SensitivityColumns& columns);

}  // namespace limen::analysis
