// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/incremental_voxelization/incremental_settings.h"

#include <cmath>

namespace limen::techniques {

const SettingsTable<CubeAroundCamera>& CubeAroundCamera::table() {
  using S = CubeAroundCamera;
  static const SettingsTable<S> kTable = {
      {&S::extent, "extent", {0.01, 4.0}, "", "Side of the cube as a share of the scene's diagonal"},
      {&S::step, "step", {1, 256}, "voxels", "The cube moves by multiples of this"},
      {&S::move, "move", "What becomes of voxels when the cube moves", "Gaitatzes 2012, section 7.9 (empty)"},
      {&S::sway, "sway", "The cube moves by a step and back from frame to frame, to time what a move costs",
       "Gaitatzes 2012, section 7.9"}};
  return kTable;
}

const SettingsTable<LightMapSettings>& LightMapSettings::table() {
  using S = LightMapSettings;
  static const SettingsTable<S> kTable = {
      {&S::use, "use", "What the light's depth image is for", "Gaitatzes 2012, section 7.4"},
      {&S::resolution,
       "resolution",
       {16, 8192},
       "px",
       "Of the depth image from the light's middle, each side"},
      {&S::strength, "strength", {0.0, 10.0}, "", "Radiance of a white surface that faces the light"}};
  return kTable;
}

const SettingsTable<IncrementalSettings>& IncrementalSettings::table() {
  using S = IncrementalSettings;
  static const SettingsTable<S> kTable = {
      {&S::resolution,
       "resolution",
       {1, 512},
       "voxels",
       "Of the longest side of the grid",
       "Gaitatzes 2012, Table 8"},
      {&S::box, "box", "What the grid's box encloses"},
      {&S::lightMap, "light_map", "Depth image from the middle of the scene's first light"},
      {&S::sequence, "sequence", "Frames before the picture", "Gaitatzes 2012, Fig. 76"}};
  return kTable;
}

bool scrolls(const IncrementalBox& box) {
  const auto* around = std::get_if<CubeAroundCamera>(&box);
  return around && around->move == BoxMove::Scroll;
}

voxels::VoxelGrid gridFor(const scene::Scene& scene, const scene::Camera& camera, const IncrementalBox& box,
                          int resolution) {
  const auto* around = std::get_if<CubeAroundCamera>(&box);
  if (!around)
    return voxels::tightGrid(
        std::holds_alternative<IncrementalBoxOfCasters>(box) ? scene.casterBounds() : scene.bounds(),
        resolution);
  voxels::VoxelGrid grid;
  const double diagonal = scene.bounds().diagonal(),
               side = around->extent * (diagonal > 0.0 ? diagonal : 1.0);
  grid.resolution = glm::ivec3(resolution);
  grid.voxelSize = side / resolution;
  // Relative to the scene, not to the world's origin, which may be far away.
  const glm::dvec3 from = scene.bounds().empty() ? glm::dvec3(0.0) : scene.bounds().low;
  const double step = around->step * grid.voxelSize;
  grid.origin = from + step * glm::round((camera.eye - 0.5 * side - from) / step);
  return grid;
}

}  // namespace limen::techniques
