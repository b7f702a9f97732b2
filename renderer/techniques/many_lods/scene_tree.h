// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/base/quantity.h"
#include "experiments/base/settings_table.h"
#include "renderer/frame/frame.h"
#include "renderer/frame/shaded.h"
#include "renderer/many_lods/gpu_tree.h"
#include "renderer/many_lods/multi_cut.h"
#include "renderer/many_lods/value_tree.h"
#include "renderer/many_lods/view_atlas.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {

/// Points on the scene's surface and the tree over them.
struct TreeSettings {
  int levels = 16;
  double leafScale = 2.0;
  int64_t seed = 1;
  bool update = true;
  many_lods::Discs discs = many_lods::Discs::Oriented;
  static const SettingsTable<TreeSettings>& table();
};

/// How many nodes there may be.
struct CutLimits {
  double epsilonPx = 1.0;
  int64_t room = 16384;
  /// Of the lists of so many views.
  uint32_t capacity(uint32_t views) const;
  static const SettingsTable<CutLimits>& table();
};
inline constexpr const char *kCutsText = "Where cuts start in a frame and how far they go",
                            *kCutsSource = "Holländer 2013, section 3.5.2";

/// The tree of a frame's scene, brought up to date in each frame.
class SceneTree {
 public:
  /// `balanced`: complete; else split where volumes are least (many_lods::buildUnbalancedTree()).
  SceneTree(frame::Frame& frame, const TreeSettings& settings, bool balanced = true);
  /// Opens the pass many_lods/update. Nothing to do where nothing moves and settings do not ask for it.
  void update(frame::Frame& frame) const;

  /// Cuts of this tree, which is prepared for what they need to know.
  many_lods::MultiCut cutsFor(frame::Frame& frame, uint32_t views, const CutLimits& limits,
                              const many_lods::CutMode& mode);

  const many_lods::GpuTree& tree() const { return *tree_; }
  double buildMs() const { return buildMs_; }
  /// For drawing: nodes nearer than `nearest` radii of leaves are left out.
  many_lods::ViewAtlas::Settings discs(double nearest, float radiusScale = 1.0F) const;

 private:
  TreeSettings settings_;
  std::optional<many_lods::GpuTree> tree_;
  double buildMs_ = 0.0;
};

/// Light of the surface at the points, towards the camera, and its means for all nodes.
class TreeLight {
 public:
  TreeLight(frame::Frame& frame, const many_lods::GpuTree& tree, const frame::ShadedSetting& shading);
  void make(frame::Frame& frame, const many_lods::GpuTree& tree) const;
  const gl::Buffer& values() const { return values_.values(); }

 private:
  frame::ShadedSetting shading_;
  const gl::Program& program_;
  many_lods::ValueTree values_;
};

inline constexpr const char *kUpdatePass = "many_lods/update", *kLightPass = "many_lods/light",
                            *kCutsPass = "many_lods/cuts", *kSplatPass = "many_lods/splat";

/// Counters of cuts, after an update that counted.
std::vector<Counter> cutCounters(const many_lods::CutControl& control, uint32_t views, const SceneTree& tree);
std::vector<Quantity> cutQuantities();

}  // namespace limen::techniques
