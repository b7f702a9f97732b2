// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "analysis/answer_tables/answer_columns.h"
#include "analysis/observer_statistics/anova.h"

namespace limen::analysis {

/// Columns of a table for an analysis of variance, as typed.
struct AnovaColumns {
  std::string subject;
  std::vector<std::string> within;
  AnswerColumns answers;
  bool dropIncomplete = false;  ///< leave out subjects who miss a cell, who are refused otherwise
};

/// Each row is an observation of a subject in a cell; counts weigh by their trials, so that they say what
/// their single trials would. Throws Error with row and column as the readers of columns do, and for fewer
/// than two subjects, a factor of one level or one that does not vary within subjects, or a subject who
/// misses a cell.
GroupObservations readGroupObservations(const Table& table, const AnovaColumns& columns);

PartAnova tableAnova(const Table& table, const AnovaColumns& columns, const AnovaSettings& settings);

}  // namespace limen::analysis
