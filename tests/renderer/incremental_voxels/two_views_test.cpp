// SPDX-License-Identifier: BSD-3-Clause
// What the camera's image and the light's do for each other.
#include <optional>
#include <utility>
#include <vector>

#include "renderer/incremental_voxels/clean_up.h"
#include "renderer/incremental_voxels/depth_view.h"
#include "renderer/incremental_voxels/injection.h"
#include "renderer/incremental_voxels/sampled_volume.h"
#include "renderer/incremental_voxels/single_pass.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "tests/renderer/voxels/voxelizer_fixture.h"

namespace limen::incremental_voxels {
namespace {

class TwoViewsTest : public voxels::VoxelizerFixture {};

/// Two walls, a screen before either view, and a box in the middle, each if it is there.
scene::Scene screened(bool box, bool fromCamera, bool fromLight) {
  scene::Scene scene;
  const auto add = [&](const char* name, glm::dvec3 low, glm::dvec3 high) {
    scene::addPart(scene, name, scene::box(low, high), glm::vec3(0.5F));
  };
  add("behind", {-2.0, -2.0, -1.6}, {2.0, 2.0, -1.5});
  add("left", {-1.6, -2.0, -2.0}, {-1.5, 2.0, 2.0});
  if (box) add("box", {-0.21, -0.19, -0.22}, {0.2, 0.22, 0.19});
  if (fromCamera) add("screen", {-0.5, -0.5, 0.9}, {0.5, 0.5, 1.0});
  if (fromLight) add("screen", {0.9, -0.5, -0.5}, {1.0, 0.5, 0.5});
  scene.lights = {scene::lightTowards({2.6, 0.1, 0.03}, {0.0, 0.02, 0.0}, glm::dvec2(0.1))};
  scene::setStillCamera(scene, {{0.02, 0.05, 2.6}, {0.0, 0.01, 0.0}, {0.0, 1.0, 0.0}, 60.0});
  return scene;
}

// A box that both have seen is gone behind a screen that hides its place from the one: with the other's image
// its voxels are cleared, without it they stay. Either way round, by clean-up and by a single pass.
TEST_F(TwoViewsTest, EachImageClearsWhatTheOtherCannotSee) {
  voxels::VoxelGrid grid;
  grid.origin = glm::dvec3(-1.8);
  grid.voxelSize = 0.1;
  grid.resolution = glm::ivec3(30);
  const auto inPlace = [&](const SampledVolume& volume) {
    const std::vector<uint8_t> found = volume.readOccupied();
    int64_t count = 0;
    glm::ivec3 v;
    for (v.z = 14; v.z < 22; ++v.z)
      for (v.y = 14; v.y < 22; ++v.y)
        for (v.x = 14; v.x < 22; ++v.x) count += found[static_cast<size_t>(grid.indexOf(v))];
    return count;
  };
  const PointSettings points{.side = 128};
  for (const bool hiddenFromCamera : {true, false})
    for (const bool single : {false, true}) {
      std::vector<int64_t> left;
      for (const bool both : {false, true}) {
        const int used = both ? 2 : 1;
        std::optional<SampledVolume> volume;
        for (const bool before : {true, false}) {
          const scene::Scene scene =
              before ? screened(true, false, false) : screened(false, hiddenFromCamera, !hiddenFromCamera);
          const frame::GpuScene gpuScene(scene);
          frame::Frame frame(context(), scene, gpuScene, {128, 128});
          LightMap map(context(), 128, frame::Raster::Auto);
          if (before) volume.emplace(context(), grid, gpuScene.anchor(), false, 2, 2 * points.perStep());
          frame.begin();
          map.draw(frame, {grid.origin, grid.high()});
          std::vector<DepthView> views = {cameraView(frame), map.view()};
          volume->turn();
          if (before) {
            Injection(context(), points, *volume, 2, 2).run(frame, *volume, views, {}, 0);
          } else {
            // The one that sees nothing of the place first, or alone.
            if (!hiddenFromCamera) std::swap(views[0], views[1]);
            views.resize(static_cast<size_t>(used));
            if (single)
              SinglePass(context(), {.proof = Proof::Centre}, *volume, used, used)
                  .run(frame, *volume, views, {});
            else
              CleanUp(context(), {}, *volume, used, used).run(*volume, views, gpuScene.anchor());
          }
          frame.end();
          if (before) {
            ASSERT_GT(inPlace(*volume), 30);
          }
        }
        left.push_back(inPlace(*volume));
      }
      EXPECT_GT(left[0], 30) << hiddenFromCamera << single;
      EXPECT_EQ(left[1], 0) << hiddenFromCamera << single;
    }
}

}  // namespace
}  // namespace limen::incremental_voxels
