// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "analysis/statistics/interval.h"

namespace limen::analysis {

struct WithinFactor {
  std::string name;
  size_t levels = 0;
};

/// One value per subject and cell of a design in which every subject sees every cell.
struct RepeatedMeasures {
  std::vector<WithinFactor> factors;
  size_t subjects = 0;
  /// By subject, then by the first factor, ..., the last factor varying fastest.
  std::vector<double> values;
  /// Cells were averaged over unequal numbers of observations. The analysis is then that of unweighted cell
  /// means.
  bool unequalReplicates = false;
};

struct CellObservation {
  size_t subject = 0;
  std::vector<size_t> levels;  ///< one index for each factor
  double value = 0.0;
  double weight = 1.0;  ///< number of trials averaged in `value`
};

/// Averages repetitions within each cell, by their weights. limen::Error for an index out of range, a value
/// that is not finite or a weight that is not above 0 (names the observation), and for a cell without
/// observations (names subject and levels): a subject who misses a cell has to be left out, or the factor
/// reduced; no value is imputed.
RepeatedMeasures averageCells(const std::vector<WithinFactor>& factors, size_t subjects,
                              const std::vector<CellObservation>& observations);

/// Whether differences between levels have equal variance, and by how much degrees of freedom shrink if not.
struct Sphericity {
  /// Mauchly (1940): W = det(S) / (tr(S)/d)^d of the covariance S of the d orthonormal contrasts; p from the
  /// second-order expansion of Box (Anderson 2003, section 10.7). R 4.2 has a wrong second-order term if it
  /// makes the contrasts itself. None with fewer subjects than d + 1.
  std::optional<double> mauchlyW, mauchlyP;
  double greenhouseGeisser = 1.0;  ///< tr(S)^2 / (d tr(S^2)); between 1/d and 1
  double huynhFeldt = 1.0;  ///< (n d e - 2) / (d (n - 1 - d e)), clamped to 1; e is Greenhouse and Geisser's
  double pGreenhouseGeisser = 1.0, pHuynhFeldt = 1.0;
};

struct AnovaEffect {
  std::string name;             ///< "lod", "lod x distance"
  std::vector<size_t> factors;  ///< indices of the factors involved
  double df = 0.0, dfError = 0.0;
  double sumOfSquares = 0.0, errorSumOfSquares = 0.0;
  /// F = MS of the effect / MS of its interaction with subjects. +infinity with p = 0 if that interaction
  /// vanishes but the effect does not; none, like p, if both vanish.
  std::optional<double> f, p;
  std::optional<double> partialEtaSquared;  ///< SS / (SS + error SS)
  /// From noncentral F (Steiger 2004): bounds of the noncentrality L turned into L / (L + df + dfError + 1).
  /// None if F is infinite or missing, or df F is above 1e8. A common choice with a test at 5 % is the level
  /// 0.9.
  std::optional<Interval> partialEtaSquaredInterval;
  /// SS / (SS + SS of subjects + all error SS) (Olejnik and Algina 2003), all factors being manipulated.
  std::optional<double> generalisedEtaSquared;
  std::optional<Sphericity> sphericity;  ///< for df > 1, if there is any error variance
  std::string note;                      ///< why something is missing or infinite; empty otherwise
};

struct RepeatedMeasuresAnova {
  size_t subjects = 0;
  double grandMean = 0.0;
  double subjectSumOfSquares = 0.0;  ///< between subjects
  std::vector<AnovaEffect> effects;  ///< main effects, then interactions of two, of three, ...
};

/// Univariate repeated-measures analysis of variance: each effect is tested against its own interaction with
/// subjects (Winer, Brown and Michels 1991, chapter 4; Schwarz 2009, section 10.4). Sums of squares below the
/// rounding error of the values count as zero. limen::Error for fewer than two subjects, no factor, a factor
/// of fewer than two levels, values that are missing, too many or not finite.
RepeatedMeasuresAnova analyseRepeatedMeasures(const RepeatedMeasures& data, double level = 0.95);

/// Mean of each subject at each level of one factor, averaged over other factors: by level, then by subject.
/// Values that are mathematically equal agree to about 1e-16 of the largest.
std::vector<std::vector<double>> levelMeans(const RepeatedMeasures& data, size_t factor);

/// Two levels of one factor, averaged over other factors, by a paired t test over subjects.
struct PairedComparison {
  size_t first = 0, second = 0;  ///< levels
  double difference = 0.0;       ///< mean of first minus second
  Interval interval;             ///< of the difference, not adjusted
  double df = 0.0;
  /// +-infinity with p = 0 if all subjects differ by the same amount; 0 with p = 1 if none differs.
  double t = 0.0, p = 1.0;
  double pHolm = 1.0;                            ///< adjusted over all pairs of the factor
  std::optional<double> standardisedDifference;  ///< d_z = mean / sd of the differences; none for sd 0
};

/// All pairs of levels, (0,1), (0,2), ..., (1,2), ... Errors as above, and for a factor that does not exist.
std::vector<PairedComparison> comparePairs(const RepeatedMeasures& data, size_t factor, double level = 0.95);

}  // namespace limen::analysis
