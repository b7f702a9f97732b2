// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/lod_pair.h"

#include <cmath>

#include "renderer/frame/g_buffer.h"
#include "renderer/frame/motion.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "tests/renderer/gl/gl_fixture.h"

namespace limen::frame {
namespace {

constexpr glm::ivec2 kPairSize{48, 36};
constexpr double kDt = 0.1;

class LodPairTest : public gl::GlTest {};

/// A sphere in two levels before a wall, met by a camera that moves sideways.
scene::Scene passing() {
  scene::LodSet set;
  set.name = "ball";
  for (const int cells : {12, 2})
    set.levels.push_back({scene::sphere(glm::dvec3(0.0), 1.0, cells), 0.0, 0.0});
  scene::Scene scene;
  scene::addPart(scene, "wall", scene::card({0.0, 0.0, -3.0}, {20.0, 0.0, 0.0}, {0.0, 20.0, 0.0}),
                 glm::vec3(0.3F));
  scene::addLodObject(scene, set, {}, {"ball", glm::vec3(0.8F)}, {5.0});
  scene.lights = {scene::lightTowards({-30.0, 50.0, 40.0}, glm::dvec3(0.0), glm::dvec2(1.0))};
  scene::Camera from, to;
  from.eye = {-1.0, 0.0, 6.0};
  from.target = {-1.0, 0.0, 0.0};
  to.eye = {1.0, 0.0, 6.0};
  to.target = {1.0, 0.0, 0.0};
  scene.camera.keys = {{0.0, from}, {1.0, to}};
  return scene;
}

/// A frame of one selection on its own.
struct Alone {
  Image colour, depth, displacement;
};
Alone alone(gl::Context& context, const scene::Scene& scene, const scene::LodSelection& selection,
            double timeS, const ShadedSetting& shaded) {
  const GpuScene gpuScene(scene);
  Frame frame(context, scene, gpuScene, kPairSize, timeS);
  frame.setLevels(selection);
  frame.begin();
  Alone out{frame.get<Shaded>(shaded).texture().read(),
            frame.get<GBufferChannel>(ChannelSetting{Channel::Depth}).texture().read(),
            frame.get<Motion>(MotionSetting{kDt}).displacement().read()};
  frame.end();
  return out;
}

TEST_F(LodPairTest, IsTheFrameWithNewAndOldLevelsNowAndBefore) {
  const scene::Scene scene = passing();
  const GpuScene gpuScene(scene);
  Frame frame(context(), scene, gpuScene, kPairSize, 0.5);
  LodPairSetting setting;
  setting.dtS = kDt;
  LodPair pair(frame, setting);
  const auto [actual, predicted] = objectChange(scene::finestLevels(scene), 0, 0, 1);
  EXPECT_EQ(actual.levels, std::vector<int>{1});
  EXPECT_EQ(predicted.levels, std::vector<int>{0});
  for (const double timeS : {0.5, 0.8}) {  // also after the frame has moved on
    frame.setTime(timeS);
    pair.setLevels(actual, predicted);
    frame.begin();
    pair.render();
    frame.end();
    const Alone now = alone(context(), scene, actual, timeS, setting.shaded),
                kept = alone(context(), scene, predicted, timeS, setting.shaded),
                nowBefore = alone(context(), scene, actual, timeS - kDt, setting.shaded),
                keptBefore = alone(context(), scene, predicted, timeS - kDt, setting.shaded);
    EXPECT_EQ(pair.actual().colour->read().data, now.colour.data);
    EXPECT_EQ(pair.actual().depth->read().data, now.depth.data);
    EXPECT_EQ(pair.actual().displacement->read().data, now.displacement.data);
    EXPECT_EQ(pair.actual().depthBefore->read().data, nowBefore.depth.data);
    EXPECT_EQ(pair.predicted().colour->read().data, kept.colour.data);
    EXPECT_EQ(pair.predicted().depth->read().data, kept.depth.data);
    EXPECT_EQ(pair.predicted().displacement->read().data, kept.displacement.data);
    EXPECT_EQ(pair.predicted().depthBefore->read().data, keptBefore.depth.data);
    EXPECT_EQ(pair.previousColour()->read().data, keptBefore.colour.data);
    EXPECT_EQ(pair.actual().shadedBefore, pair.actual().colour);
    EXPECT_NE(now.colour.data, kept.colour.data);
  }
}

TEST_F(LodPairTest, DepthsTellWhatThePreviousFrameCouldNotSee) {
  const scene::Scene scene = passing();
  const GpuScene gpuScene(scene);
  Frame frame(context(), scene, gpuScene, kPairSize, 0.95);
  LodPairSetting setting;
  setting.dtS =
      0.9;  // 1.8 units: at 43 px a unit and distance 9 and 6, 9 px for the wall, 13 px for the ball
  LodPair pair(frame, setting);
  pair.setLevels(scene::finestLevels(scene), scene::finestLevels(scene));
  frame.begin();
  pair.render();
  frame.end();
  const Image motion = pair.actual().displacement->read(), then = pair.actual().previousDepth->read(),
              before = pair.actual().depthBefore->read(), depth = pair.actual().depth->read();
  // The camera moved right, so the ball moved left over the wall and left of where it was the wall comes out
  // on its right side. A wall point hidden before has the ball's depth at its place of then.
  const glm::dvec3 eye = scene.camera.at(0.05).eye;
  size_t hidden = 0;
  for (int y = 0; y < kPairSize.y; ++y)
    for (int x = 0; x < kPairSize.x; ++x) {
      const double px = x + 0.5 - motion.at(x, y, 0), py = y + 0.5 - motion.at(x, y, 1);
      const int i = static_cast<int>(std::floor(px)), j = static_cast<int>(std::floor(py));
      if (i < 0 || j < 0 || i >= kPairSize.x || j >= kPairSize.y) continue;
      if (!(depth.at(x, y) > 8.0F)) continue;  // the wall, at distance 9
      const bool covered = before.at(i, j) < then.at(x, y) - 0.5F;
      // The ray from the eye of then to the wall point against the unit sphere.
      const double tangent = std::tan(glm::radians(22.5)),
                   u = (px / kPairSize.x * 2 - 1) * tangent * kPairSize.x / kPairSize.y,
                   v = (1 - py / kPairSize.y * 2) * tangent;
      const glm::dvec3 d = glm::normalize(glm::dvec3(u, v, -1.0));
      const double b = glm::dot(eye, d),
                   miss = glm::dot(eye, eye) - b * b;        // squared distance from the middle
      if (std::abs(std::sqrt(miss) - 1.0) < 0.15) continue;  // within a pixel of the silhouette
      EXPECT_EQ(covered, miss < 1.0) << x << ' ' << y;
      hidden += covered;
    }
  EXPECT_GT(hidden, 20U);
}

TEST_F(LodPairTest, HighlightsOfThePreviousSetupAreThoseOfThePreviousEye) {
  const scene::Scene scene = passing();
  const GpuScene gpuScene(scene);
  Frame frame(context(), scene, gpuScene, kPairSize, 0.5);
  LodPairSetting setting;
  setting.dtS = 0.4;
  setting.shaded.specular = 1.0;
  LodPair pair(frame, setting);
  pair.setLevels(scene::finestLevels(scene), scene::finestLevels(scene));
  frame.begin();
  pair.render();
  const Image now = pair.actual().colour->read(), before = pair.actual().shadedBefore->read();
  frame.end();
  EXPECT_NE(now.data, before.data);
  // The same picture with the highlight worked out for the eye of then, in double precision, on the wall.
  const scene::Camera camera = scene.camera.at(0.5), then = scene.camera.at(0.1);
  const glm::dvec3 light = scene.lights[0].centre;
  for (const auto& [image, eye] : {std::pair{&now, camera.eye}, std::pair{&before, then.eye}}) {
    const double tangent = std::tan(glm::radians(22.5));
    const glm::dvec3 p(camera.eye.x + (2 * 2.5 / kPairSize.x - 1) * tangent * kPairSize.x / kPairSize.y * 9.0,
                       (1 - 2 * 3.5 / kPairSize.y) * tangent * 9.0, -3.0);
    const glm::dvec3 l = glm::normalize(light - p), v = glm::normalize(eye - p), h = glm::normalize(l + v);
    EXPECT_NEAR(image->at(2, 3), 0.3 * (0.2 + 0.8 * l.z) + std::pow(h.z, 32.0), 1e-5);
  }
}

}  // namespace
}  // namespace limen::frame
