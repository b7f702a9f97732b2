// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/techniques/perceptual_lod/settings.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {

/// Result of an exhaustive search for one object: for each of its levels, how many pixels show the object at
/// that level or at the finest, and in how many of them the picture differs visibly from the finest.
struct OracleVerdict {
  std::vector<uint32_t> coveredPx, visiblePx;
  /// Whether a level differs by more than `rule.upper`, in the rule's unit.
  bool isVisible(const LevelRule& rule, int level) const;
  /// The coarsest level that does not.
  int coarsestInvisible(const LevelRule& rule) const;
  /// Whether anything of the object is in the picture, at any level.
  bool seen() const;
};

/// Brute force, one picture for every level of every object, all others being at their finest: thresholds
/// come from the double-precision map of the whole finest picture, the object included, and every pixel of
/// the object is compared in double precision. Allocates and waits for the GPU.
std::vector<OracleVerdict> searchLevels(frame::Frame& like, double timeS, const frame::ShadedSetting& shading,
                                        const SeenOn& seenOn);

/// Share of the seen objects whose level the oracle finds visible; mean over them of how many levels they are
/// coarser (above) or finer (below) than the oracle's.
struct OracleComparison {
  double wrongInvisibleShare = 0.0, levelsAbove = 0.0, levelsBelow = 0.0;
  int objectsSeen = 0;
};
OracleComparison compareWithOracle(const std::vector<OracleVerdict>& verdicts, const LevelRule& rule,
                                   const std::vector<int>& levels);

/// "triangles_drawn" and "mean_level" of a level selection.
std::vector<Counter> countLevels(const scene::Scene& scene, const std::vector<int>& levels);
/// Adds "wrong_invisible_share", "levels_above_oracle", "levels_below_oracle" and "objects_seen".
void countOracle(frame::Frame& frame, double timeS, const frame::ShadedSetting& shading, const SeenOn& seenOn,
                 const LevelRule& rule, const std::vector<int>& levels, std::vector<Counter>& out);
/// Declarations of all of these.
std::vector<Quantity> levelQuantities();

}  // namespace limen::techniques
