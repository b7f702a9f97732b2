// SPDX-License-Identifier: BSD-3-Clause
// Conservative coverage of the forms that send triangles to slices, against exact sets in double precision.
#include "renderer/techniques/voxelization/axis_volumes.h"
#include "renderer/techniques/voxelization/voxelization_bindings.h"
#include "renderer/voxels/voxel_bindings.h"
#include "tests/renderer/voxels/triangle_soup.h"
#include "tests/renderer/voxels/voxelizer_fixture.h"

namespace limen::techniques {
namespace {

class ConservativeRasterTest : public voxels::VoxelizerFixture {
 protected:
  static std::vector<uint8_t> found(const scene::Scene& scene, const voxels::VoxelGrid& grid, bool cut) {
    const std::string folder = "renderer/techniques/voxelization/";
    AxisVolumes::Form form{.stages = {folder + "slice.vert.glsl", folder + "conservative.geom.glsl",
                                      folder + "conservative.frag.glsl"},
                           .defines = {{"CAP", "128"}, {"CONSERVATIVE", "1"}},
                           .lamps = {}};
    if (cut) form.defines["CUT"] = "1";
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, {16, 16});
    const voxels::Volume volume(context(), grid, gpuScene.anchor());
    AxisVolumes volumes(frame, volume, form);
    frame.begin();
    volumes.fill(frame, volume);
    frame.end();
    return volume.readOccupied();
  }
};

// A corner that the rasteriser rounds to 2^-9 px lies within 2^-8 px more of where it was, and depths within
// kVoxelSlack; both along two axes at most. A sliver's outline is exact but for as much on both of its sides.
const double kGrown = 4.0 * (kRasterSlack + voxels::kVoxelSlack);

// All that the mesh meets, slivers, segments and points too, and nothing beyond rounding. The largest
// triangle reaches 14 slices, which is what 128 vertices serve.
TEST_F(ConservativeRasterTest, FillsWhatTheMeshMeetsAndNothingElse) {
  for (const int64_t seed : {1, 2, 3}) {
    const scene::Scene scene = voxels::soup(seed);
    const voxels::VoxelGrid grid = voxels::tightGrid(scene.bounds(), 20);
    const std::vector<uint8_t> exact = voxels::exactVoxels(scene.mesh, grid);
    for (const bool cut : {false, true}) {
      const std::vector<uint8_t> voxels = found(scene, grid, cut);
      EXPECT_EQ(voxels::compare(voxels, exact).missing, 0) << cut;
      EXPECT_EQ(voxels::beyond(voxels, scene.mesh, grid, kGrown), 0) << cut;
      EXPECT_GT(voxels::countOf(voxels), 1000);
    }
  }
}

// A triangle of a hundredth of a voxel that covers no column's middle, in its own voxel only.
TEST_F(ConservativeRasterTest, KeepsTrianglesBetweenTheMiddles) {
  scene::Scene scene;
  scene::Mesh mesh;
  mesh.positions = {{2.2, 3.3, 1.2}, {2.21, 3.3, 1.2}, {2.2, 3.31, 1.21}};
  mesh.triangles = {{0, 1, 2}};
  scene::addPart(scene, "tiny", mesh, glm::vec3(0.5F));
  voxels::VoxelGrid grid;
  grid.resolution = glm::ivec3(6);
  for (const bool cut : {false, true}) {
    const std::vector<uint8_t> voxels = found(scene, grid, cut);
    EXPECT_EQ(voxels::countOf(voxels), 1);
    EXPECT_EQ(voxels[static_cast<size_t>(grid.indexOf({2, 3, 1}))], 1);
  }
}

}  // namespace
}  // namespace limen::techniques
