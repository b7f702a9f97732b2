// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/motion.h"

#include <cmath>

#include "renderer/frame/g_buffer.h"
#include "renderer/scene/stage.h"
#include "tests/renderer/frame/brute_force.h"
#include "tests/renderer/gl/gl_fixture.h"

namespace limen::frame {
namespace {

constexpr glm::ivec2 kMotionSize{56, 40};

class MotionTest : public gl::GlTest {
 protected:
  struct Made {
    Image displacement, previousDepth, depth;
    std::vector<uint32_t> ids;
  };
  static Made render(const scene::Scene& scene, double timeS, double dtS, glm::ivec2 sizePx = kMotionSize) {
    const GpuScene gpuScene(scene);
    Frame frame(context(), scene, gpuScene, sizePx, timeS);
    frame.begin();
    const Motion& motion = frame.get<Motion>(MotionSetting{dtS});
    Made made{motion.displacement().read(), motion.previousDepth().read(),
              frame.get<GBufferChannel>(ChannelSetting{Channel::Depth}).texture().read(),
              frame.get<TriangleIds>().texture().readUint()};
    frame.end();
    return made;
  }
};

/// Image position in px (row 0 at the top) and distance along the view, in double precision.
struct Projected {
  glm::dvec2 px{0.0};
  double depth = 0.0;
};
Projected project(const scene::Camera& camera, glm::dvec3 point, glm::ivec2 sizePx) {
  const glm::dvec3 forward = glm::normalize(camera.target - camera.eye),
                   right = glm::normalize(glm::cross(forward, camera.up)), up = glm::cross(right, forward);
  const glm::dvec3 d = point - camera.eye;
  const double z = glm::dot(d, forward),
               focal = 0.5 * sizePx.y / std::tan(0.5 * glm::radians(camera.verticalFovDeg));
  return {{0.5 * sizePx.x + focal * glm::dot(d, right) / z, 0.5 * sizePx.y - focal * glm::dot(d, up) / z}, z};
}

/// Boxes under a camera that moves, turns and zooms.
scene::Scene movingBoxes(double scale, double offset) {
  scene::Scene scene = builtScene("two_boxes", {{"scale", scale}, {"offset", offset}});
  const scene::Camera from = scene.camera.at(0.0);
  scene::Camera to = from;
  const glm::dvec3 view = from.target - from.eye;
  to.eye += 0.3 * view + 0.1 * glm::length(view) * glm::dvec3(1.0, 0.2, 0.0);
  to.target += 0.05 * glm::length(view) * glm::dvec3(0.3, 1.0, 0.0);
  to.verticalFovDeg = from.verticalFovDeg * 1.2;
  scene.camera.keys = {{0.0, from}, {1.0, to}};
  return scene;
}

/// One of the boxes turns by 20 degrees and travels by some of the size of the scene in a tenth of a second.
scene::Scene boxThatMoves(scene::Scene scene) {
  scene::PartMotion motion;
  motion.part = static_cast<uint32_t>(scene.parts.size() - 1);
  motion.pivot = scene.mesh.positions[scene.mesh.triangles[scene.parts.back().firstTriangle].x];
  motion.axis = glm::normalize(glm::dvec3(0.2, 1.0, 0.1));
  motion.turnDegS = 200.0;
  motion.travel = 0.05 * scene.bounds().diagonal() * glm::dvec3(0.5, 0.3, -0.6);
  motion.startS = -0.5;
  scene.motions = {motion};
  return scene;
}

/// Motion of each triangle; null: it rests.
const scene::PartMotion* motionOf(const scene::Scene& scene, uint32_t triangle) {
  for (const scene::PartMotion& motion : scene.motions) {
    const scene::Part& part = scene.parts[motion.part];
    if (triangle >= part.firstTriangle && triangle < part.firstTriangle + part.triangleCount) return &motion;
  }
  return nullptr;
}

TEST_F(MotionTest, IsTheReprojectionOfEachPixelsPoint) {
  struct Case {
    double scale, offset;
    bool partMoves;
  };
  for (const auto& [scale, offset, partMoves] : std::vector<Case>{
           {1.0, 0.0, false}, {1e-4, 0.0, false}, {1.0, 1e5, false}, {1.0, 0.0, true}, {1.0, 1e5, true}}) {
    scene::Scene scene = movingBoxes(scale, offset);
    if (partMoves) scene = boxThatMoves(scene);
    int moving = 0;
    const Made made = render(scene, 0.6, 0.1);
    const scene::Camera now = scene.camera.at(0.6), then = scene.camera.at(0.5);
    const glm::dvec3 forward = glm::normalize(now.target - now.eye),
                     right = glm::normalize(glm::cross(forward, now.up)), up = glm::cross(right, forward);
    const double tangent = std::tan(0.5 * glm::radians(now.verticalFovDeg));
    double largest = 0.0;
    for (int y = 0; y < kMotionSize.y; ++y)
      for (int x = 0; x < kMotionSize.x; ++x) {
        const double depth = made.depth.at(x, y);
        ASSERT_GT(depth, 0.0);
        const double nx = (2.0 * (x + 0.5) / kMotionSize.x - 1.0) * tangent * kMotionSize.x / kMotionSize.y,
                     ny = (1.0 - 2.0 * (y + 0.5) / kMotionSize.y) * tangent;
        const glm::dvec3 point = now.eye + depth * (forward + nx * right + ny * up);
        glm::dvec3 before = point;
        if (const scene::PartMotion* own =
                motionOf(scene, made.ids[static_cast<size_t>(y * kMotionSize.x + x)])) {
          before = glm::dvec3(own->at(0.5) * glm::inverse(own->at(0.6)) * glm::dvec4(point, 1.0));
          ++moving;
        }
        const Projected old = project(then, before, kMotionSize);
        const glm::dvec2 expected = glm::dvec2(x + 0.5, y + 0.5) - old.px;
        // Float's 24 bits over a picture of 56 px, and the depth's own error times the motion it causes.
        EXPECT_NEAR(made.displacement.at(x, y, 0), expected.x, 2e-4);
        EXPECT_NEAR(made.displacement.at(x, y, 1), expected.y, 2e-4);
        EXPECT_NEAR(made.previousDepth.at(x, y), old.depth, 1e-4 * old.depth);
        largest = std::max(largest, glm::length(expected));
      }
    EXPECT_GT(largest, 1.0) << "the camera hardly moves, the test says nothing";
    EXPECT_EQ(moving > 50, partMoves) << moving;
  }
}

TEST_F(MotionTest, ACameraAtRestMovesNothingAtAll) {
  const scene::Scene scene = builtScene("two_boxes", {{"offset", 1e4}});
  for (const float value : render(scene, 0.0, 0.1).displacement.data) EXPECT_EQ(value, 0.0F);
}

/// A small square far ahead; most of the picture is background.
scene::Scene squareAhead(const scene::Camera& from, const scene::Camera& to) {
  scene::Scene scene;
  scene.mesh.positions = {{-1.0, -1.0, -100.0}, {1.0, -1.0, -100.0}, {1.0, 1.0, -100.0}, {-1.0, 1.0, -100.0}};
  scene.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  scene.parts = {{"square", 0, 2, 0, false}};
  scene.materials = {{"square", glm::vec3(0.5F)}};
  scene.camera.keys = {{0.0, from}, {1.0, to}};
  return scene;
}

TEST_F(MotionTest, BackgroundMovesWithTheTurnOfTheCameraAlone) {
  scene::Camera from, to;
  from.eye = to.eye = {0.0, 0.0, 0.0};
  from.target = {0.0, 0.0, -1.0};
  to.target = {std::sin(0.1), 0.0, -std::cos(0.1)};
  to.eye = {3.0, 1.0, 2.0};  // a shift that infinity does not see
  to.target += to.eye;
  const scene::Scene scene = squareAhead(from, to);
  const Made made = render(scene, 1.0, 1.0);
  const double focal = 0.5 * kMotionSize.y / std::tan(glm::radians(22.5));
  size_t background = 0;
  for (int y = 0; y < kMotionSize.y; ++y)
    for (int x = 0; x < kMotionSize.x; ++x) {
      if (made.ids[static_cast<size_t>(y * kMotionSize.x + x)] != TriangleIds::kNone) continue;
      ++background;
      EXPECT_EQ(made.previousDepth.at(x, y), 0.0F);
      // A turn by 0.1 rad to the right: the direction at angle a now was at a + 0.1 then.
      const double u = (x + 0.5 - 0.5 * kMotionSize.x) / focal, v = (0.5 * kMotionSize.y - y - 0.5) / focal;
      const double c = std::cos(0.1), s = std::sin(0.1), z = c - u * s;
      const glm::dvec2 then((u * c + s) / z * focal + 0.5 * kMotionSize.x,
                            0.5 * kMotionSize.y - v / z * focal);
      EXPECT_NEAR(made.displacement.at(x, y, 0), x + 0.5 - then.x, 2e-4);
      EXPECT_NEAR(made.displacement.at(x, y, 1), y + 0.5 - then.y, 2e-4);
    }
  EXPECT_GT(background, 1000U);
}

TEST_F(MotionTest, APointFromBehindIsMarkedAndFinite) {
  scene::Camera from, to;
  from.eye = {0.0, 0.0, -150.0};  // past the square
  from.target = {0.0, 0.0, -151.0};
  to.eye = {0.0, 0.0, -97.0};
  to.target = {0.0, 0.0, -98.0};
  const Made made = render(squareAhead(from, to), 1.0, 1.0);
  const double diagonal = std::hypot(kMotionSize.x, kMotionSize.y);
  size_t behind = 0;
  for (int y = 0; y < kMotionSize.y; ++y)
    for (int x = 0; x < kMotionSize.x; ++x) {
      const double length = std::hypot(made.displacement.at(x, y, 0), made.displacement.at(x, y, 1));
      ASSERT_TRUE(std::isfinite(length));
      if (made.ids[static_cast<size_t>(y * kMotionSize.x + x)] == TriangleIds::kNone) {
        EXPECT_NEAR(length, 0.0, 1e-4);  // straight ahead: infinity stays
        continue;
      }
      ++behind;
      EXPECT_EQ(made.previousDepth.at(x, y), -1.0F);
      EXPECT_NEAR(length, diagonal, 1e-3);
    }
  EXPECT_GT(behind, 50U);
}

TEST_F(MotionTest, OnePixelIsFinite) {
  for (const glm::ivec2 size : {glm::ivec2(1, 1), glm::ivec2(1, 9)})
    for (const float value : render(movingBoxes(1.0, 0.0), 0.5, 0.5, size).displacement.data)
      EXPECT_TRUE(std::isfinite(value));
}

}  // namespace
}  // namespace limen::frame
