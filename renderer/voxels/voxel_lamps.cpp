// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/voxels/voxel_lamps.h"

#include <algorithm>
#include <array>
#include <string>

#include "renderer/frame/light_paths.h"
#include "renderer/ray_tracing/ray_scene.h"
#include "renderer/voxels/voxel_bindings.h"

namespace limen::voxels {

bool castsShadows(const frame::Frame& frame, const VolumeAttributes& attributes, const VoxelLamps& lamps) {
  return attributes.lit() && lamps.shadows && !frame.scene().lights.empty();
}

gl::ShaderDefines surfaceDefines(const frame::Frame& frame, const VolumeAttributes& attributes,
                                 const VoxelLamps& lamps) {
  gl::ShaderDefines defines;
  if (attributes.pattern) defines["PATTERN"] = "1";
  if (attributes.lit()) defines["VOXEL_LIT"] = "1";
  if (castsShadows(frame, attributes, lamps)) {
    defines["TRACED"] = "1";
    if (frame.scene().traits().count("refractive_materials") != 0) defines["TRANSPARENT"] = "1";
    defines["MOST_PASSAGES"] = std::to_string(frame::kMostPassages);
  }
  return defines;
}

void configureSurfaces(const gl::Program& program, frame::Frame& frame, const VolumeAttributes& attributes,
                       const VoxelLamps& lamps, const ray_tracing::RayTree* tree) {
  program.set("largestLight", attributes.largestLight);
  if (!attributes.lit()) return;
  static constexpr std::array<const char*, kVoxelLamps> kPositions = {
      "lampPositions[0]", "lampPositions[1]", "lampPositions[2]", "lampPositions[3]",
      "lampPositions[4]", "lampPositions[5]", "lampPositions[6]", "lampPositions[7]"};
  const auto& lights = frame.scene().lights;
  const size_t count = std::min(lights.size(), lamps.all ? kPositions.size() : size_t{1});
  for (size_t i = 0; i < count; ++i)
    program.set(kPositions[i], glm::vec3(lights[i].centre - frame.gpuScene().anchor()));
  program.set("lampCount", static_cast<int>(count));
  program.set("lampStrength", static_cast<float>(lamps.strength));
  if (castsShadows(frame, attributes, lamps))
    (tree ? *tree : frame.gpuScene().rays(frame.context())).bind(program);
}

}  // namespace limen::voxels
