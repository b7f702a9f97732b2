// SPDX-License-Identifier: BSD-3-Clause
// A frame with chosen levels shows what the scene of those levels alone would show.
#include <cmath>

#include "renderer/frame/g_buffer.h"
#include "renderer/frame/shaded.h"
#include "renderer/scene/lod_set.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "tests/renderer/gl/gl_fixture.h"

namespace limen::frame {
namespace {

constexpr glm::ivec2 kLevelsSize{64, 48};

class LodLevelsTest : public gl::GlTest {};

/// Three spheres in three levels each above a ground that lies between them in the list of parts.
scene::Scene spheres() {
  scene::LodSet set;
  set.name = "sphere";
  for (const int cells : {8, 4, 2}) {
    scene::LodMesh level;
    level.mesh = scene::sphere(glm::dvec3(0.0), 1.0, cells);
    for (const glm::dvec3& p : level.mesh.positions) level.mesh.normals.emplace_back(glm::normalize(p));
    set.levels.push_back(std::move(level));
  }
  scene::Scene scene;
  const auto add = [&](double x, glm::vec3 albedo) {
    scene::Material material{"sphere", albedo};
    scene::addLodObject(scene, set, {{x, 1.1, 0.3 * x}, 20.0 * x, 1.0 + 0.1 * x}, material, {5.0, 10.0});
  };
  add(-2.0, {0.9F, 0.1F, 0.1F});
  scene::addGround(scene, 12.0);
  add(0.0, {0.1F, 0.9F, 0.1F});
  add(2.0, {0.1F, 0.1F, 0.9F});
  scene::frameStanding(scene, 2.0, 3.0);
  return scene;
}

Image render(Frame& frame) {
  ShadedSetting setting;
  setting.shadow = true;
  setting.shadowResolution = 256;
  frame.begin();
  Image out = frame.get<Shaded>(setting).texture().read();
  frame.end();
  return out;
}

TEST_F(LodLevelsTest, ChosenLevelsLookLikeASceneOfThemAlone) {
  const scene::Scene scene = spheres();
  const GpuScene gpuScene(scene);
  for (const Raster raster : {Raster::Hardware, Raster::Compute}) {
    Frame frame(context(), scene, gpuScene, kLevelsSize, 0.0, raster);
    for (const scene::LodSelection& selection :
         {scene::LodSelection{{0, 0, 0}, true}, scene::LodSelection{{1, 2, 0}, true},
          scene::LodSelection{{2, -1, 1}, true}, scene::LodSelection{{-1, 1, -1}, false}}) {
      frame.setLevels(selection);
      const scene::Scene alone = scene::withLevels(scene, selection);
      EXPECT_EQ(scene::triangleCount(scene, selection), alone.mesh.triangles.size());
      EXPECT_EQ(frame.geometry().triangleCount(), alone.mesh.triangles.size());
      const GpuScene gpuAlone(alone);
      Frame other(context(), alone, gpuAlone, kLevelsSize, 0.0, raster);
      const Image a = render(frame), b = render(other);
      size_t different = 0;
      for (size_t i = 0; i < a.pixels(); ++i) {
        float largest = 0.0F;
        for (size_t c = 0; c < 3; ++c)
          largest = std::max(largest, std::abs(a.data[4 * i + c] - b.data[4 * i + c]));
        different += largest > 1e-4F;
      }
      // Anchors and shadow frusta differ with the bounds, so silhouettes and shadow edges may fall otherwise;
      // a wrong level or a wrong material would show in hundreds of pixels.
      EXPECT_LE(different, a.pixels() / 100);
    }
  }
}

TEST_F(LodLevelsTest, WithoutAChoiceTheFinestIsShownAndAnEmptyOneShowsBackground) {
  const scene::Scene scene = spheres();
  const GpuScene gpuScene(scene);
  Frame frame(context(), scene, gpuScene, kLevelsSize);
  const Image whole = render(frame);
  frame.setLevels(scene::finestLevels(scene));
  EXPECT_EQ(render(frame).data, whole.data);
  frame.setLevels({{-1, -1, -1}, false});
  for (const float value : render(frame).data) EXPECT_TRUE(value == 0.05F || value == 1.0F);
  frame.setLevels(scene::finestLevels(scene));
  EXPECT_EQ(render(frame).data, whole.data);
}

TEST_F(LodLevelsTest, AViewWithinAFrameHasItsOwnLevelsSizeAndPassNames) {
  const scene::Scene scene = spheres();
  const GpuScene gpuScene(scene);
  Frame frame(context(), scene, gpuScene, kLevelsSize);
  Frame coarse(frame, "coarse", kLevelsSize / 2);
  coarse.setLevels(scene::uniformLevels(scene, 2));
  frame.begin();
  coarse.begin();
  const Image a = frame.get<Shaded>(ShadedSetting{}).texture().read();
  const Image b = coarse.get<Shaded>(ShadedSetting{}).texture().read();
  coarse.end();
  frame.end();
  EXPECT_EQ(b.width, kLevelsSize.x / 2);
  std::set<std::string> ran;
  for (const auto& pass : frame.passes().passes())
    if (pass.ran) ran.insert(pass.name);
  EXPECT_EQ(ran, (std::set<std::string>{"frame/triangle_ids", "frame/shaded", "coarse/frame/triangle_ids",
                                        "coarse/frame/shaded"}));
}

TEST_F(LodLevelsTest, AMissingLevelIsRefused) {
  const scene::Scene scene = spheres();
  EXPECT_THROW(scene::rangesOf(scene, {{0, 0, 3}, true}), Error);
  EXPECT_THROW(scene::rangesOf(scene, {{0, 0}, true}), Error);
}

}  // namespace
}  // namespace limen::frame
