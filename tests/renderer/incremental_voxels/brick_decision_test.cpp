// SPDX-License-Identifier: BSD-3-Clause
// Whole bricks that are decided by tiles of depth images end as their voxels would, one by one.
#include <algorithm>

#include "renderer/incremental_voxels/clean_up.h"
#include "renderer/incremental_voxels/single_pass.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "tests/renderer/voxels/voxelizer_fixture.h"

namespace limen::incremental_voxels {
namespace {

class BrickDecisionTest : public voxels::VoxelizerFixture {
 protected:
  /// Boxes before nothing; the grid reaches far beyond them.
  static scene::Scene boxes(const scene::Camera& camera) {
    scene::Scene scene;
    scene::addPart(scene, "wall", scene::box({-1.2, -0.8, -1.5}, {0.9, 0.9, -1.3}), glm::vec3(0.5F));
    scene::addPart(scene, "box", scene::box({-0.3, -0.4, -0.6}, {0.2, 0.3, 0.1}), glm::vec3(0.5F));
    scene.lights = {scene::lightTowards({1.3, 1.1, 1.9}, {0.0, 0.1, -1.0}, glm::dvec2(0.2))};
    scene::setStillCamera(scene, camera);
    return scene;
  }
  static voxels::VoxelGrid wideGrid() {
    voxels::VoxelGrid grid;
    grid.origin = {-2.0, -1.7, -2.9};
    grid.voxelSize = 0.045;
    grid.resolution = {90, 73, 101};
    return grid;
  }
  /// Seven of eight voxels.
  static std::vector<uint8_t> someVoxels(const voxels::VoxelGrid& grid) {
    scene::Random random(7);
    std::vector<uint8_t> out(static_cast<size_t>(grid.count()));
    for (uint8_t& one : out) one = random.uniform(0.0, 8.0) < 7.0 ? 1 : 0;
    return out;
  }

  struct Result {
    std::vector<uint8_t> voxels;
    SampleCounts counts;
  };
  /// What a pass of a kind leaves, with and without tiles. Returns the number of bricks that tiles decide.
  template <class Make, class Run>
  static int64_t compareFor(const scene::Scene& scene, int used, Make make, Run run) {
    const voxels::VoxelGrid grid = wideGrid();
    const std::vector<uint8_t> before = someVoxels(grid);
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, {93, 71});
    LightMap map(context(), 64, frame::Raster::Auto);
    std::vector<glm::ivec2> sizes = {frame.sizePx()};
    if (used == 2) sizes.emplace_back(64);
    std::vector<Result> results;
    for (const bool tiled : {false, true}) {
      SampledVolume volume(context(), grid, gpuScene.anchor(), false, used, 1);
      volume.occupancy().writeOccupied(before);
      const auto pass = make(volume, tiled ? sizes : std::vector<glm::ivec2>());
      frame.begin();
      std::vector<DepthView> views = {cameraView(frame)};
      if (used == 2) {
        map.draw(frame, {grid.origin, grid.high()});
        views.push_back(map.view());
      }
      run(pass, frame, volume, views);
      frame.end();
      results.push_back({volume.occupancy().readOccupied(), volume.counts()});
    }
    EXPECT_EQ(results[0].voxels, results[1].voxels);
    EXPECT_EQ(results[0].counts.kept, results[1].counts.kept);
    EXPECT_EQ(results[0].counts.cleared, results[1].counts.cleared);
    EXPECT_EQ(results[0].counts.added, results[1].counts.added);
    EXPECT_GT(results[0].counts.cleared, 1000U);
    return int64_t{results[0].counts.tested} - results[1].counts.tested;
  }
  static std::vector<scene::Camera> cameras() {
    return {{{-0.4, 0.3, 2.6}, {0.05, 0.0, -0.4}, {0.1, 1.0, 0.0}, 42.0},  // outside the grid
            {{0.1, 0.5, 0.7}, {-0.5, -0.1, -0.9}, {0.0, 1.0, 0.0}, 75.0},  // within it
            {{3.0, 2.0, -4.5}, {0.0, 0.0, -1.0}, {0.0, 1.0, 0.0}, 12.0}};  // bricks wider than the image
  }
};

TEST_F(BrickDecisionTest, CleanUpLeavesTheSameVoxels) {
  int64_t decided = 0;
  for (const scene::Camera& camera : cameras()) {
    const scene::Scene scene = boxes(camera);
    for (const int used : {1, 2})
      for (const Proof proof : {Proof::Centre, Proof::Support, Proof::Footprint})
        for (const bool sky : {true, false})
          decided += compareFor(
              scene, used,
              [&](const SampledVolume& volume, const std::vector<glm::ivec2>& tiledPx) {
                const CleanUpSettings settings{.bias = RadiusBias{}, .proof = proof, .sky = sky};
                return CleanUp(context(), settings, volume, used, used, tiledPx);
              },
              [](const CleanUp& pass, frame::Frame& frame, const SampledVolume& volume,
                 const std::vector<DepthView>& views) {
                pass.run(volume, views, frame.gpuScene().anchor());
              });
  }
  EXPECT_GT(decided, 1000);
}

TEST_F(BrickDecisionTest, ASinglePassLeavesTheSameVoxels) {
  int64_t decided = 0;
  for (const scene::Camera& camera : cameras()) {
    const scene::Scene scene = boxes(camera);
    for (const int used : {1, 2})
      decided += compareFor(
          scene, used,
          [&](const SampledVolume& volume, const std::vector<glm::ivec2>& tiledPx) {
            const CleanUpSettings settings{.bias = RadiusBias{}, .proof = Proof::Centre, .sky = true};
            return SinglePass(context(), settings, volume, used, used, tiledPx);
          },
          [](const SinglePass& pass, frame::Frame& frame, const SampledVolume& volume,
             const std::vector<DepthView>& views) { pass.run(frame, volume, views, {}); });
  }
  EXPECT_GT(decided, 300);
}

}  // namespace
}  // namespace limen::incremental_voxels
