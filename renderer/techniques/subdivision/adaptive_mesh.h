// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/base/settings_table.h"
#include "renderer/compute/prefix_sum.h"
#include "renderer/techniques/subdivision/table_evaluator.h"

namespace limen::techniques {

enum class EdgeLevels {
  ByLength,  ///< from an edge's length on the screen
  Random     ///< any, for tests (Holländer 2013, figure 2.11)
};
constexpr EnumNames<EdgeLevels, 2> enumNames(EdgeLevels) {
  return {{{{EdgeLevels::ByLength, "length"}, {EdgeLevels::Random, "random"}}}};
}

struct AdaptiveMeshSettings {
  static constexpr const char *kKind = "edges",
                              *kSummary = "a level for each edge, up to `level`; in compute alone";
  EdgeLevels levels = EdgeLevels::ByLength;
  double segmentPx = 4.0;  ///< length on the screen that a segment may have
  bool morph = true;       ///< vertices of the finest level come in along straight lines
  static const SettingsTable<AdaptiveMeshSettings>& table();
};

/// A level for each edge of the refined mesh, from the edge alone, so that both of its patches agree; a patch
/// has the largest of its edges' levels (Holländer 2013, section 2.2.3). Vertices of a patch that its side
/// has no place for go to the nearest place that it has. Each patch has vertices of its own; on sides they
/// are the same bits.
class AdaptiveMesh {
 public:
  AdaptiveMesh(gl::Context& context, const TableEvaluator& evaluator, const AdaptiveMeshSettings& settings);
  /// After the evaluator's first steps. Passes "levels", "main" and "indices".
  void run(frame::Frame& frame) const;

  const gl::Buffer& vertices() const { return vertices_; }  ///< TessellatedVertex
  const gl::Buffer& indices() const { return indices_; }
  const gl::Buffer& totals() const { return totals_; }  ///< AdaptiveTotals
  int64_t mostTriangles() const { return indices_.bytes() / 12; }
  int64_t bytes() const;

 private:
  void dispatchPatches(const gl::Program& program) const;

  const TableEvaluator& evaluator_;
  AdaptiveMeshSettings settings_;
  uint32_t patches_;
  const gl::Program &levelsProgram_, &countsProgram_, &verticesProgram_, &indicesProgram_;
  gl::Buffer levels_, counts_, offsets_, vertices_, indices_, totals_;
  compute::PrefixSum scan_;
};

}  // namespace limen::techniques
