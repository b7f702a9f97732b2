// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/answer_tables/answer_columns.h"
#include "analysis/output/result.h"
#include "analysis/statistics/detection_rates.h"
#include "analysis/statistics/rank_tests.h"
#include "analysis/statistics/repeated_measures_anova.h"
#include "experiments/base/enum_names.h"

namespace limen::analysis {

/// A factor within subjects and its levels, by name.
struct NamedFactor {
  std::string name;
  std::vector<std::string> levels;
};

/// What was measured: of each subject one value or more in each cell of the factors.
struct GroupObservations {
  std::vector<NamedFactor> factors;
  std::vector<std::string> subjects;
  std::vector<CellObservation> observations;  ///< levels and subjects as indices
};

/// A subject without a value in some cells.
struct IncompleteSubject {
  size_t subject = 0;
  size_t missing = 0;         ///< cells
  std::vector<size_t> first;  ///< levels of the first of them
};
std::vector<IncompleteSubject> incompleteSubjects(const GroupObservations& data);
/// "lod=near, distance=4"
std::string cellName(const std::vector<NamedFactor>& factors, const std::vector<size_t>& levels);

/// Of the mean of each cell, before anything is tested.
enum class RateTransform {
  None,
  /// asin(sqrt(p)), in radians: the variance of a rate then hardly depends on it (Winer, Brown and Michels
  /// 1991, chapter 5).
  Arcsine
};
constexpr EnumNames<RateTransform, 2> enumNames(RateTransform) {
  return {{{{RateTransform::None, "none"}, {RateTransform::Arcsine, "arcsine"}}}};
}

struct AnovaSettings {
  RateTransform transform = RateTransform::None;
  bool ranks = false;  ///< tests on ranks too
};

struct RankComparison {
  size_t first = 0, second = 0;  ///< levels
  SignedRankTest test;
  double pHolm = 1.0;  ///< adjusted over all pairs of the factor
};

/// Levels of one factor, other factors averaged. Intervals have the level 0.95.
struct FactorComparison {
  std::vector<MeanOverSubjects> means;  ///< of each level
  std::vector<PairedComparison> pairs;
  std::optional<FriedmanTest> friedman;  ///< if tests on ranks were asked for
  std::vector<RankComparison> rankPairs;
};

/// What a study printed for an effect, to be set beside one's own.
struct PublishedEffect {
  double f = 0.0, df = 0.0, dfError = 0.0;
  std::string p;          ///< as printed
  bool fDerived = false;  ///< F and df were not printed; F is the one that p belongs to
  std::string remark;
  std::string source;
};

/// Analysis of variance of a table, or of one part of a study.
struct PartAnova {
  std::string part;                     ///< "" of a table
  std::string of;                       ///< "yes", "right", or a table's column
  std::string measure;                  ///< the same in a sentence: "rate of 'yes' in trials with a change"
  bool rates = true;                    ///< values are rates, from 0 to 1
  std::vector<NamedFactor> factors;     ///< within subjects
  std::vector<std::string> incomplete;  ///< subjects without a value in some cell: left out here
  bool unequalReplicates = false;
  RateTransform transform = RateTransform::None;
  std::optional<RepeatedMeasuresAnova> result;
  std::vector<FactorComparison> comparisons;              ///< of each factor
  std::vector<std::optional<PublishedEffect>> published;  ///< of each effect, none of a table
  std::string note;                                       ///< why there is no result
};

/// Fills what follows from the data: `factors`, `incomplete`, `unequalReplicates`, `transform`, `result`,
/// `comparisons`, with room for `published`. Subjects who miss a cell are left out; if fewer than two are
/// left, `note` says so. limen::Error for a rate outside of [0, 1] that is to be transformed, and as
/// analyseRepeatedMeasures().
void analyseGroup(PartAnova& out, const GroupObservations& data, const AnovaSettings& settings);

/// Tables "factors", "effects", "levels", "pairs", and of ranks "friedman" and "rank_pairs".
Section sectionOf(const PartAnova& part);
Result resultOf(const std::vector<PartAnova>& parts);

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
