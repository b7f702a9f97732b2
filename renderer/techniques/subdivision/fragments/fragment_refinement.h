// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "experiments/base/settings_table.h"
#include "renderer/compute/prefix_sum.h"
#include "renderer/frame/frame.h"
#include "renderer/techniques/subdivision/fragments/fragment_layout.h"

namespace limen::techniques {

struct FlatLevels {
  static constexpr const char *kKind = "flat", *kSummary = "for each fragment and side as many as it takes";
  double tolerancePx = 0.5;
  static const SettingsTable<FlatLevels>& table();
};

/// Fragments subdivided on the GPU: each step reads the points of one level and writes those of the next,
/// until all fragments have their level; then vertices go to the limit. Neighbours have the same bits along
/// their common side, whatever their levels.
class FragmentRefinement {
 public:
  /// `steps`: of the finest level. `flat`: levels for each fragment and side; null: the finest for all.
  /// Throws Error if the vertices at the finest level do not fit into buffers.
  FragmentRefinement(gl::Context& context, const FragmentLayout& layout, int steps, const FlatLevels* flat);

  /// Passes "levels" (if these differ), "refine" and "limits", from positions of the refined control mesh
  /// (ControlVertex).
  void run(frame::Frame& frame, const gl::Buffer& controls) const;

  const gl::Buffer& vertices() const { return vertices_; }  ///< TessellatedVertex
  const gl::Buffer& indices() const { return indices_; }
  const gl::Buffer& totals() const { return totals_; }  ///< AdaptiveTotals
  int64_t mostTriangles() const { return indices_.bytes() / 12; }
  int64_t bytes() const;
  /// Points that the steps of the last run made; waits for the GPU.
  double pointsMade() const;
  /// Of the last run, by level; waits for the GPU.
  std::vector<uint32_t> fragmentsByLevel() const;

 private:
  int64_t pointsOf(int level) const;  ///< of a fragment
  void configure(const gl::Program& program, int level) const;
  /// Of `level`, if levels differ: as many as its fragments need.
  void dispatchLevel(const gl::Program& program, int level, int64_t each, size_t groups) const;
  static void dispatch(const gl::Program& program, int64_t invocations);
  void list() const;

  uint32_t count_, ringPoints_;
  int steps_;
  std::optional<FlatLevels> flat_;
  const gl::Program &gather_, &refine_, &limits_, &levelsProgram_, &indicesProgram_, &lists_, &dispatches_;
  gl::Buffer listBuffer_, dispatchBuffer_;  ///< where levels differ
  gl::Buffer fragments_, controls_, points_[2], levels_, counts_, offsets_, vertices_, indices_, totals_;
  compute::PrefixSum scan_;
};

}  // namespace limen::techniques
