// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/answer_tables/answer_columns.h"
#include "analysis/output/result.h"
#include "analysis/statistics/detection_rates.h"
#include "analysis/statistics/signal_detection.h"

namespace limen::analysis {

/// Signal detection of one observer (of a table: of one group of rows), or of all answers together.
struct SensitivityRow {
  std::string part, observer;  ///< observer "": all answers together
  YesNoCounts counts;          ///< yes/no tasks
  std::optional<YesNoSensitivity> yesNo;
  int64_t correct = 0, trials = 0;  ///< tasks with several alternatives
  std::optional<MAfcSensitivity> mAfc;
};

/// Of one part of a study, or of one condition of a table.
struct PartSensitivity {
  std::string part, title;  ///< title: part or condition in words
  bool yesNo = true;
  int alternatives = 2;
  RateCorrection correction = RateCorrection::kLogLinear;
  bool subjects = true;              ///< rows are people, and not conditions or both
  std::vector<SensitivityRow> rows;  ///< observers, then all answers together
  /// Means over rows but the last; of alternatives d' only. Intervals here and of rows have the level 0.95.
  std::optional<MeanOverSubjects> dPrime, criterion, lnBeta, aPrime;
  std::string note;  ///< why there is nothing, or what to mind
};

/// Fills `yesNo` or `mAfc` of the rows from their counts, and the means. A row without one kind of trials has
/// no sensitivity. limen::Error, which names the row, as analyseYesNo() and analyseMAfc().
void analyseSensitivity(PartSensitivity& part);

/// Tables "rows" and "means".
Section sectionOf(const PartSensitivity& part);
Result resultOf(const std::vector<PartSensitivity>& parts);

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

/// Rows of the same names are added up. Throws Error with row and column as the readers of columns do, and
/// for columns that do not fit the task.
std::vector<PartSensitivity> tableSensitivity(const Table& table, const SensitivityColumns& columns);

}  // namespace limen::analysis
