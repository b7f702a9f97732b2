// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/correlations/cluster_bootstrap.h"
#include "analysis/correlations/relation_table.h"
#include "analysis/output/result.h"
#include "analysis/statistics/roc.h"

namespace limen::analysis {

struct AreaSetting {
  bool probabilities = false;  ///< x are: calibration too
  size_t bins = 10;            ///< of the calibration
  BootstrapSetting bootstrap;  ///< its level is that of all intervals
};

/// How well one column tells outcomes of 1 from 0.
struct ColumnArea {
  std::string x;
  RocArea area;
  std::vector<RocPoint> curve;
  std::optional<ResampledInterval> bootstrap;  ///< over clusters; none if there are no clusters
};

/// Two columns on the same rows (DeLong, DeLong and Clarke-Pearson 1988).
struct AreaDifference {
  std::string first, second;
  RocComparison comparison;
  std::optional<double> holm;  ///< p adjusted for the pairs of the group; none for a single pair
  std::optional<ResampledInterval> bootstrap;
};

struct ColumnCalibration {
  std::string x;
  Calibration calibration;
};

struct AreaGroup {
  std::string name;  ///< "" if there is one only
  size_t rows = 0, positives = 0, clusters = 0;
  std::vector<ColumnArea> areas;  ///< none if outcomes are of one kind, which a note says
  std::vector<AreaDifference> differences;
  std::vector<ColumnCalibration> calibrations;
  std::vector<std::string> notes;
};

struct Areas {
  AreaSetting setting;
  std::string outcome, cluster;
  std::vector<AreaGroup> groups;
};

/// Areas under the curve of each x, their differences and, for probabilities, calibration; group by group.
Areas compareAreas(const std::vector<RelationRows>& groups, const RelationColumns& columns,
                   const AreaSetting& setting);

/// A section for each group with tables "areas", "differences", "calibration" and "bins".
Result resultOf(const Areas& areas);
/// Curves of each group in a panel of their own, and what was observed against what was predicted, with the
/// gnuplot script and data beside FILE.svg, .pdf or .png. Throws Error.
void drawAreas(const Areas& areas, const std::string& path);

}  // namespace limen::analysis
