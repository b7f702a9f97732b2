// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "analysis/answer_tables/answer_columns.h"
#include "analysis/output/result.h"
#include "analysis/statistics/mixed_logistic.h"

namespace limen::analysis {

/// Answers of groups, such as subjects, with what was shown, as text.
struct MixedRows {
  std::string measure;                                      ///< what is modelled, in words
  std::string group;                                        ///< what a group is: "subject"
  std::vector<std::string> groups;                          ///< of each row
  std::vector<AnswerCount> answers;                         ///< of each row
  std::map<std::string, std::vector<std::string>> columns;  ///< by name, of each row
  /// Order of a column's levels, where it is known; of others that of levelsIn().
  std::map<std::string, std::vector<std::string>> levels;
  /// Where a row has its value of a column, for messages.
  std::function<std::string(size_t row, const std::string& column)> place;
};

/// A model of such rows, as typed.
struct MixedTerms {
  std::vector<std::string> fixed;  ///< "a", and interactions "a:b" beside all that they are made of
  std::string slope;               ///< fixed effect along which each group has a slope of its own; "": none
  std::vector<std::string> references;   ///< "colour=red": level that the others are compared with
  std::vector<std::string> categorical;  ///< columns of numbers that are names of levels
  std::vector<std::string> log, centre;  ///< of numbers: natural logarithm, then minus the mean over rows
};

/// A column that takes part and how it was coded: numbers as they are, or treatment coding, a column of 0 and
/// 1 for each level but the reference.
struct ModelColumn {
  std::string name;
  bool numeric = true, logarithmic = false, centred = false;
  double centre = 0.0;              ///< what was taken off
  std::vector<std::string> levels;  ///< of one that is not numeric; the first is the reference
};

struct MixedModel {
  std::string measure, group, slope;
  size_t rows = 0;
  int64_t successes = 0, trials = 0;
  std::vector<ModelColumn> columns;
  std::vector<std::string> groups;  ///< names of MixedLogistic::groups
  MixedLogistic fit;                ///< intervals of the level 0.95
};

/// Builds the design and fits it. A column is numeric if all its values are numbers. Throws Error for an
/// unknown or doubled name, numbers mixed with text, an empty value, a logarithm of what is not above 0, one
/// level only, an interaction without its parts, a slope that is not one column, and as fitMixedLogistic().
MixedModel fitMixedModel(const MixedRows& rows, const MixedTerms& terms);

/// One section with tables "columns", "fixed", "random" and "groups".
Result resultOf(const MixedModel& model);

/// Columns of a design matrix, without the intercept.
struct MixedDesign {
  std::vector<ModelColumn> sources;
  std::vector<std::string> names;            ///< "x", "colour=red", "x:colour=red"
  std::vector<std::vector<double>> columns;  ///< by name, then by row
  size_t slope = 0;                          ///< index of names, if a slope was asked for
};

/// Errors as fitMixedModel().
MixedDesign buildDesign(const MixedRows& rows, const MixedTerms& terms);

/// Rows of a table; every column can be an effect. Throws Error with row and column as the readers of columns
/// do, and for an empty group.
MixedRows readMixedRows(const Table& table, const std::string& group, const AnswerColumns& columns);

}  // namespace limen::analysis
