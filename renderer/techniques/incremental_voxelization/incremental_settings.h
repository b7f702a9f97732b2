// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>

#include "experiments/base/enum_names.h"
#include "experiments/base/settings_table.h"
#include "renderer/scene/scene.h"
#include "renderer/techniques/frames_before.h"
#include "renderer/voxels/voxel_grid.h"

namespace limen::techniques {

struct IncrementalBoxOfScene {
  static constexpr const char *kKind = "scene", *kSummary = "the whole scene, wherever its parts move";
};
struct IncrementalBoxOfCasters {
  static constexpr const char *kKind = "casters", *kSummary = "what casts shadows";
};
/// What becomes of voxels where a box moves.
enum class BoxMove {
  Empty,  ///< all are emptied
  Scroll  ///< those stay that are still in it
};
constexpr EnumNames<BoxMove, 2> enumNames(BoxMove) {
  return {{{{BoxMove::Empty, "empty"}, {BoxMove::Scroll, "scroll"}}}};
}

/// A cube that goes with the camera.
struct CubeAroundCamera {
  static constexpr const char *kKind = "around_camera", *kSummary = "a cube around the eye, moved in steps";
  double extent = 0.5;
  int step = 8;
  BoxMove move = BoxMove::Scroll;
  bool sway = false;
  static const SettingsTable<CubeAroundCamera>& table();
};
using IncrementalBox = std::variant<IncrementalBoxOfScene, IncrementalBoxOfCasters, CubeAroundCamera>;

bool scrolls(const IncrementalBox& box);

/// The grid in which a camera's frame is voxelized.
voxels::VoxelGrid gridFor(const scene::Scene& scene, const scene::Camera& camera, const IncrementalBox& box,
                          int resolution);

/// What the light's depth image is for.
enum class LightMapUse {
  Shade,  ///< shadows on samples of the camera's
  Voxels  ///< it gives samples and disproves voxels too, as the camera's does
};
constexpr EnumNames<LightMapUse, 2> enumNames(LightMapUse) {
  return {{{{LightMapUse::Shade, "shade"}, {LightMapUse::Voxels, "voxels"}}}};
}

/// How whole bricks of voxels are decided before any of their voxels is looked at.
enum class BrickDecision {
  None,
  Tiles  ///< by the least and the largest depth of tiles of the depth images
};
constexpr EnumNames<BrickDecision, 2> enumNames(BrickDecision) {
  return {{{{BrickDecision::None, "none"}, {BrickDecision::Tiles, "tiles"}}}};
}

struct LightMapSettings {
  LightMapUse use = LightMapUse::Voxels;
  int resolution = 512;
  double strength = 0.8;
  static const SettingsTable<LightMapSettings>& table();
};

struct IncrementalSettings {
  int resolution = 64;
  IncrementalBox box = IncrementalBoxOfScene{};
  LightMapSettings lightMap;
  FramesBefore sequence;  ///< what a volume that is kept from frame to frame has seen
  static const SettingsTable<IncrementalSettings>& table();
};

}  // namespace limen::techniques
