// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/correlations/areas.h"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/statistics/multiple_comparisons.h"
#include "perception/psychometrics/random.h"

namespace limen::analysis {
namespace {

size_t positivesOf(const std::vector<int>& outcomes) {
  return static_cast<size_t>(std::count(outcomes.begin(), outcomes.end(), 1));
}

/// Intervals of the areas, then of the differences.
void resample(AreaGroup& group, const RelationRows& rows, const BootstrapSetting& setting) {
  const size_t columns = group.areas.size();
  const auto of = [&](const std::vector<size_t>& drawn) {
    std::vector<std::optional<double>> out(columns + group.differences.size());
    std::vector<int> outcomes;
    for (const size_t row : drawn) outcomes.push_back(rows.outcome[row]);
    const size_t positives = positivesOf(outcomes);
    if (positives == 0 || positives == outcomes.size()) return out;
    std::vector<double> scores(drawn.size());
    for (size_t i = 0; i < columns; ++i) {
      for (size_t j = 0; j < drawn.size(); ++j) scores[j] = rows.x[i][drawn[j]];
      out[i] = rocArea(scores, outcomes).area;
    }
    size_t next = columns;
    for (size_t i = 0; i < columns; ++i)
      for (size_t j = i + 1; j < columns; ++j) out[next++] = *out[i] - *out[j];
    return out;
  };
  const auto found = resampleClusters(rows.clusters, columns + group.differences.size(), of, setting);
  for (size_t i = 0; i < columns; ++i) group.areas[i].bootstrap = found[i];
  for (size_t i = 0; i < group.differences.size(); ++i) group.differences[i].bootstrap = found[columns + i];
}

void compare(AreaGroup& group, const RelationRows& rows, const RelationColumns& columns, double level) {
  for (size_t i = 0; i < columns.x.size(); ++i)
    for (size_t j = i + 1; j < columns.x.size(); ++j)
      group.differences.push_back(
          {columns.x[i], columns.x[j], compareRocAreas(rows.x[i], rows.x[j], rows.outcome, level), {}, {}});
  if (group.differences.size() < 2) return;
  adjustHolm(
      group.differences, [](const AreaDifference& one) { return one.comparison.p; }, &AreaDifference::holm);
}

}  // namespace

Areas compareAreas(const std::vector<RelationRows>& groups, const RelationColumns& columns,
                   const AreaSetting& setting) {
  Areas out{setting, columns.outcome, columns.cluster, {}};
  const double level = setting.bootstrap.level;
  for (const RelationRows& rows : groups) {
    AreaGroup group;
    group.name = rows.name;
    group.rows = rows.rows;
    group.positives = positivesOf(rows.outcome);
    group.clusters = rows.clusterCount;
    if (setting.probabilities)
      for (size_t i = 0; i < columns.x.size(); ++i)
        group.calibrations.push_back({columns.x[i], calibrate(rows.x[i], rows.outcome, setting.bins, level)});
    if (group.positives == 0 || group.positives == group.rows) {
      group.notes.push_back(
          fmt::format("{} is {} in every row: no area", columns.outcome, group.positives > 0 ? 1 : 0));
    } else {
      for (size_t i = 0; i < columns.x.size(); ++i)
        group.areas.push_back(
            {columns.x[i], rocArea(rows.x[i], rows.outcome, level), rocPoints(rows.x[i], rows.outcome), {}});
      compare(group, rows, columns, level);
      if (!columns.cluster.empty()) {
        BootstrapSetting own = setting.bootstrap;
        own.seed = psychometrics::childSeed(own.seed, rows.name);
        resample(group, rows, own);
        if (const std::string note = noteOnClusters(rows.clusterCount, columns.cluster); !note.empty())
          group.notes.push_back(note);
      }
    }
    out.groups.push_back(std::move(group));
  }
  return out;
}

}  // namespace limen::analysis
