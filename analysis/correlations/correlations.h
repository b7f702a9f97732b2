// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/correlations/cluster_bootstrap.h"
#include "analysis/correlations/relation_table.h"
#include "analysis/output/result.h"
#include "analysis/statistics/rank_correlation.h"

namespace limen::analysis {

struct CorrelationSetting {
  bool clamp = false;          ///< clamped Pearson as well (Schwarz 2009, section 10.4.1); y are rates then
  BootstrapSetting bootstrap;  ///< its level is that of all intervals
};

/// One coefficient of a pair of columns.
struct RelationCoefficient {
  std::string name;                        ///< of coefficientNames()
  std::optional<Coefficient> coefficient;  ///< none where `reason` says why
  std::string reason;
  std::optional<double> p;     ///< two-sided, of independence; takes rows as independent
  std::optional<double> holm;  ///< p adjusted for the pairs of the group (Holm 1979); none for a single pair
  bool exact = false;          ///< p is
  /// Over clusters; none if there are no clusters, and of tau_a and tau_c, which repeated rows pull towards
  /// 0.
  std::optional<ResampledInterval> bootstrap;
};

/// "kendall_tau_a", "kendall_tau_b", "kendall_tau_c", "spearman", "pearson", "pearson_clamped".
const std::vector<std::string>& coefficientNames();

struct Relation {
  std::string x, y;
  std::vector<double> xs, ys;
  std::vector<RelationCoefficient> coefficients;
  std::optional<double> clamp;  ///< smallest x whose rate is 1; larger ones are lowered to it
  size_t clamped = 0;           ///< x that were
  bool rates = false;           ///< y are, and x is not one of them: to be clamped if that is asked for
};

struct CorrelationGroup {
  std::string name;  ///< "" if there is one only
  size_t clusters = 0;
  std::vector<Relation> relations;
  std::vector<std::string> notes;
};

struct Correlations {
  CorrelationSetting setting;
  std::string cluster;  ///< what is resampled; "" for nothing
  std::string unit;     ///< what n counts: "rows", "conditions"
  std::vector<CorrelationGroup> groups;
  std::vector<std::string> notes;
};

/// Fills in the coefficients of a pair. `clusters` as of resampleClusters(), or empty.
void correlate(Relation& relation, const std::vector<size_t>& clusters, const CorrelationSetting& setting);
/// Adjusts each coefficient's p for the pairs of the group.
void adjustGroup(CorrelationGroup& group);

/// Each x against y, group by group. A group that is too small or has a constant column is listed with the
/// reason why it has no coefficients.
Correlations correlateColumns(const std::vector<RelationRows>& groups, const RelationColumns& columns,
                              const CorrelationSetting& setting);

/// A section for each group with tables "coefficients" and "clamps".
Result resultOf(const Correlations& correlations);
/// A panel for each pair: the rows as points, the coefficients in the title; beside FILE.svg, .pdf or .png
/// lie its gnuplot script and data. Throws Error.
void drawCorrelations(const Correlations& correlations, const std::string& path);

}  // namespace limen::analysis
