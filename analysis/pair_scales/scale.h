// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/correlations/cluster_bootstrap.h"
#include "analysis/output/result.h"
#include "analysis/pair_scales/pair_table.h"
#include "analysis/statistics/detection_rates.h"
#include "analysis/statistics/pairwise_scaling.h"

namespace limen::analysis {

struct ScaleSetting {
  PairwiseModel model = PairwiseModel::kBradleyTerry;
  UnboundedScale unbounded = UnboundedScale::kRefuse;
  double priorDeviation = 2.0;  ///< of PairwiseOptions
  std::string reference;        ///< item whose value is 0; "": values sum to 0
  BootstrapSetting bootstrap;   ///< its level is that of all intervals; 0 samples for none
};

struct ScaledItem {
  std::string name;
  int64_t chosen = 0, judged = 0;
  double value = 0.0;
  /// Of the value, so against the reference if there is one; none for the reference itself.
  std::optional<double> standardError;
  std::optional<Interval> interval;  ///< value +- z error
  std::optional<ResampledInterval> bootstrap;
  /// Share of judgements that the scale predicts for it against the reference; of the ends of the bootstrap's
  /// interval, or without one of the other.
  std::optional<double> preferred;
  std::optional<Interval> preferredInterval;
};

/// An item and the next one below it on the scale.
struct ItemStep {
  std::string upper, lower;
  double difference = 0.0, standardError = 0.0;
  Interval interval;           ///< difference +- z error
  std::optional<double> z, p;  ///< of no difference, two-sided; none for a penalised scale
  std::optional<double> holm;  ///< p adjusted for the steps of the scale; none for a single one
  std::optional<ResampledInterval> bootstrap;
  double preferred = 0.5;          ///< share that the scale predicts for the upper
  int64_t chosen = 0, judged = 0;  ///< of the upper, where the two were compared themselves
};

/// What the bootstrap draws anew.
enum class ScaleBootstrap { None, Judgements, Subjects };

struct ItemScale {
  std::string name;               ///< of the group
  std::vector<ScaledItem> items;  ///< by falling value
  std::vector<ItemStep> steps;    ///< between neighbours, from the top
  PairwiseScale fit;              ///< in the group's order of items
  size_t subjects = 0;            ///< 0 if nobody is told apart
  int64_t judgements = 0;
  ScaleBootstrap bootstrap = ScaleBootstrap::None;
  size_t penalised = 0;  ///< samples of the bootstrap that were unbounded, and penalised
  size_t skipped = 0;    ///< samples whose pairs did not connect all items, and were left out
  std::vector<SubjectConsistency> consistency;
  std::optional<Rate> firstChosen;  ///< how often the item shown first won; 1/2 without bias
  std::vector<std::string> notes;
};

struct Scales {
  ScaleSetting setting;
  std::vector<ItemScale> groups;
  std::vector<std::string> notes;
};

/// A scale of each group. The bootstrap draws subjects if they are told apart (3 or more), else the
/// judgements of each pair from the proportion that was observed.
///
/// Throws Error, which names items and group: no such reference; no judgements; items that no chain of pairs
/// joins; an item infinitely far away, unless the setting asks for a penalty.
Scales scaleItems(const std::vector<PairGroup>& groups, const ScaleSetting& setting);

/// Tables "items", "steps" and "consistency".
Section sectionOf(const ItemScale& scale, const ScaleSetting& setting);
Result resultOf(const Scales& scales);
/// Values with intervals, those of the bootstrap if there are any, a panel for each group; beside FILE.svg,
/// .pdf or .png lie its gnuplot script and data. Throws Error.
void drawScales(const Scales& scales, const std::string& path);

}  // namespace limen::analysis
