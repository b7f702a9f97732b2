// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

/// Where voxelizers decide by rounding, or may not decide at all.
enum class VoxelCase {
  SlicePlanes,   ///< every face in a plane between two voxels, of any power of two of them from 8 on
  EqualNormals,  ///< normals whose components are equal by size, two or all three
  TwoColours,    ///< surfaces of two colours, facing opposite ways, in one plane
  DoubleSided    ///< a wall of two slanted sides, a thousandth of its width apart
};
constexpr EnumNames<VoxelCase, 4> enumNames(VoxelCase) {
  return {{{{VoxelCase::SlicePlanes, "slice_planes"},
            {VoxelCase::EqualNormals, "equal_normals"},
            {VoxelCase::TwoColours, "two_colours"},
            {VoxelCase::DoubleSided, "double_sided"}}}};
}

struct VoxelCaseSettings {
  VoxelCase shape = VoxelCase::SlicePlanes;
  static const SettingsTable<VoxelCaseSettings>& table() {
    using S = VoxelCaseSettings;
    static const SettingsTable<S> kTable = {
        {&S::shape, "shape", "Faces between voxels, equal components, one plane, or a thin wall",
         "Gaitatzes 2012, section 6.4"}};
    return kTable;
  }
};

void addSlicePlanes(Scene& scene) {
  addPart(scene, "frame", box({-1.0, 0.0, -1.0}, {1.0, 2.0, 1.0}), {0.6F, 0.6F, 0.6F});
  addPart(scene, "block", box({-0.5, 0.5, -0.25}, {0.25, 1.0, 0.75}), {0.8F, 0.3F, 0.1F});
}

void addEqualNormals(Scene& scene) {
  addPart(scene, "octahedron", sphere({0.0, 1.0, 0.0}, 1.0, 1), {0.6F, 0.6F, 0.6F});
  // Reaches beyond the other on three sides, so that no plane meets the corners of a tight grid's voxels.
  addPart(scene, "ramp", card({-1.383, 0.274, 0.0}, {0.487, -0.487, 0.0}, {0.0, 0.0, -1.07}),
          {0.8F, 0.3F, 0.1F});
}

void addTwoColours(Scene& scene) {
  addPart(scene, "red", card({0.0, 0.6, 0.0}, {1.0, 0.3, 0.1}, {0.1, 0.05, -0.9}), {0.9F, 0.1F, 0.1F});
  addPart(scene, "blue", card({0.0, 0.6, 0.0}, {0.1, 0.05, -0.9}, {1.0, 0.3, 0.1}), {0.1F, 0.1F, 0.9F});
}

void addDoubleSided(Scene& scene) {
  const glm::dvec3 across{1.0, 0.02, 0.03}, up{0.01, 0.9, 0.02};
  const glm::dvec3 apart = 0.001 * glm::normalize(glm::cross(across, up));
  addPart(scene, "front", card(glm::dvec3(0.0, 1.0, 0.0) + apart, across, up), {0.9F, 0.6F, 0.1F});
  addPart(scene, "back", card(glm::dvec3(0.0, 1.0, 0.0) - apart, up, across), {0.1F, 0.6F, 0.9F});
}

Scene buildVoxelCase(const VoxelCaseSettings& settings) {
  Scene scene;
  switch (settings.shape) {
    case VoxelCase::SlicePlanes:
      addSlicePlanes(scene);
      break;
    case VoxelCase::EqualNormals:
      addEqualNormals(scene);
      break;
    case VoxelCase::TwoColours:
      addTwoColours(scene);
      break;
    case VoxelCase::DoubleSided:
      addDoubleSided(scene);
      break;
  }
  scene.lights = {lightTowards({-1.5, 4.0, 2.0}, {0.0, 0.8, 0.0}, {0.3, 0.3})};
  setStillCamera(scene, orbitCamera({0.1, 0.9, 0.0}, 5.0, 24.0, 22.0));
  return scene;
}

const RegisteredScene<VoxelCaseSettings> kVoxelCasesRegistered{
    {.name = "voxel_cases",
     .version = 1,
     .summary = "What voxelizers must decide by rounding: faces between voxels, equal normals, one plane, a "
                "thin wall",
     .source = "bench, after Gaitatzes 2012, section 6.4"},
    buildVoxelCase};

}  // namespace
}  // namespace limen::scene
