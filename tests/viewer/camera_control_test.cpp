// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/camera_control.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "renderer/scene/camera_text.h"

namespace limen::viewer {
namespace {

using scene::Camera;

constexpr double kRounding = std::numeric_limits<double>::epsilon();

double distanceOf(const Camera& camera) { return glm::length(camera.eye - camera.target); }

/// Angle between the view and the up axis, degrees.
double polarDeg(const Camera& camera) {
  const glm::dvec3 view = camera.target - camera.eye;
  return glm::degrees(std::atan2(glm::length(glm::cross(view, camera.up)), glm::dot(view, camera.up)));
}

/// Largest size of a coordinate.
double reach(const Camera& camera) {
  const glm::dvec3 size = glm::max(glm::abs(camera.eye), glm::abs(camera.target));
  return std::max({size.x, size.y, size.z});
}

/// A scene of diagonal 2 near the origin and the same moved by a million diagonals; a tilted up axis of
/// another length.
std::vector<Camera> cameras() {
  const glm::dvec3 far = glm::dvec3(2e6 / std::sqrt(3.0));
  return {Camera{{1.5, 1.0, 2.5}, {0.1, 0.2, -0.1}, {0.0, 1.0, 0.0}, 40.0},
          Camera{far + glm::dvec3(1.5, 1.0, 2.5), far + glm::dvec3(0.1, 0.2, -0.1), {0.0, 1.0, 0.0}, 40.0},
          Camera{{-1.0, 2.0, 0.5}, {0.0, 0.0, 0.0}, {0.3, -2.0, 3.0}, 70.0}};
}

void expectUsable(const Camera& camera, const Camera& start) {
  ASSERT_NO_THROW(checkCamera(camera, ""));
  ASSERT_EQ(camera.up, start.up);
}

TEST(CameraControl, OrbitKeepsTargetDistanceAndUp) {
  for (const Camera& camera : cameras())
    for (const glm::dvec2 drag : {glm::dvec2(0.3, 0.0), {0.0, 0.1}, {-0.7, -0.2}, {5.0, 3.0}, {1e-9, 0.0}}) {
      const Camera moved = orbit(camera, drag);
      expectUsable(moved, camera);
      EXPECT_EQ(moved.target, camera.target);
      // The eye's three coordinates are rounded where they lie, by half a unit each: sqrt(3)/2; the rotation
      // itself takes a dozen operations on the distance.
      EXPECT_NEAR(distanceOf(moved), distanceOf(camera),
                  kRounding * (reach(camera) + 16.0 * distanceOf(camera)));
      EXPECT_LT(std::abs(distanceOf(moved) / distanceOf(camera) - 1.0), 1e-9);
    }
}

TEST(CameraControl, OrbitTurnsAsFarAsTheHandMoves) {
  const Camera camera = {{0.0, 0.0, 2.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 45.0};
  ControlSpeeds speeds;
  speeds.orbitRad = std::acos(-1.0);
  // Half a window to the right: a quarter turn, the scene's front going right, the eye left.
  EXPECT_LT(glm::length(orbit(camera, {0.5, 0.0}, speeds).eye - glm::dvec3(-2.0, 0.0, 0.0)), 1e-14);
  // A sixth of a window down: 30 degrees up.
  const glm::dvec3 above = 2.0 * glm::dvec3(0.0, 0.5, std::sqrt(0.75));
  EXPECT_LT(glm::length(orbit(camera, {0.0, 1.0 / 6.0}, speeds).eye - above), 1e-14);
}

TEST(CameraControl, OrbitStopsAtThePolesAndComesBack) {
  for (const Camera& camera : cameras())
    for (const double way : {-1.0, 1.0}) {
      const Camera pole = orbit(camera, {0.2, 10.0 * way});
      EXPECT_NEAR(polarDeg(pole), way > 0.0 ? 180.0 - kPoleDeg : kPoleDeg, 1e-6);
      // There it may still go round, and leaves the pole by the first drag the other way.
      EXPECT_NEAR(polarDeg(orbit(pole, {0.3, 0.0})), polarDeg(pole), 1e-6);
      const double back = polarDeg(orbit(pole, {0.0, -0.1 * way}));
      EXPECT_NEAR(std::abs(back - polarDeg(pole)), 18.0, 1e-6);  // a tenth of 180 degrees
    }
}

TEST(CameraControl, ACameraAtThePoleFindsAWayOut) {
  const Camera straightDown = {{0.0, 3.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 45.0};
  const Camera moved = orbit(straightDown, {0.0, -0.25});
  expectUsable(moved, straightDown);
  EXPECT_NEAR(polarDeg(moved), 135.0, 1e-9);
  // Nearer to the pole than a drag leads, a camera stays there while it goes round.
  const Camera near = {{0.0, 3.0, 0.001}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 45.0};
  EXPECT_NEAR(polarDeg(orbit(near, {0.3, 0.0})), polarDeg(near), 1e-9);
}

TEST(CameraControl, TheReverseDragReturns) {
  for (const Camera& camera : cameras()) {
    // Two steps, each as rounded as one in OrbitKeepsTargetDistanceAndUp.
    const double near = 2.0 * kRounding * (reach(camera) + 16.0 * distanceOf(camera));
    for (const glm::dvec2 drag : {glm::dvec2(0.4, 0.1), {-0.2, -0.05}, {1.7, 0.0}}) {
      EXPECT_LE(glm::length(orbit(orbit(camera, drag), -drag).eye - camera.eye), near);
      EXPECT_LE(glm::length(look(look(camera, drag), -drag).target - camera.target), near);
      const Camera panned = pan(pan(camera, drag), -drag);
      EXPECT_LE(glm::length(panned.eye - camera.eye), near);
      EXPECT_LE(glm::length(panned.target - camera.target), near);
    }
    for (const double steps : {1.0, -3.5, 20.0}) {
      // Far from the origin a distance that was shrunk by 1.1^20 = 6.7 and grown again has its rounding grown
      // too.
      EXPECT_LE(glm::length(dolly(dolly(camera, steps, 2.0), -steps, 2.0).eye - camera.eye), 8.0 * near);
      EXPECT_NEAR(zoom(zoom(camera, steps), -steps).verticalFovDeg, camera.verticalFovDeg, 1e-12);
    }
  }
}

TEST(CameraControl, NoDragChangesNothing) {
  for (const Camera& camera : cameras()) {
    for (const Camera& same : {orbit(camera, {0.0, 0.0}), look(camera, {0.0, 0.0}), pan(camera, {0.0, 0.0}),
                               dolly(camera, 0.0, 2.0), zoom(camera, 0.0), fly(camera, {}, 0.1, 2.0),
                               fly(camera, {1.0}, 0.0, 2.0)}) {
      EXPECT_EQ(same.eye, camera.eye);
      EXPECT_EQ(same.target, camera.target);
      EXPECT_EQ(same.verticalFovDeg, camera.verticalFovDeg);
    }
  }
}

TEST(CameraControl, LookKeepsEyeAndDistanceAndTurnsWithTheHand) {
  for (const Camera& camera : cameras()) {
    const Camera moved = look(camera, {0.2, -0.1});
    expectUsable(moved, camera);
    EXPECT_EQ(moved.eye, camera.eye);
    EXPECT_NEAR(distanceOf(moved), distanceOf(camera),
                kRounding * (reach(camera) + 16.0 * distanceOf(camera)));
  }
  const Camera camera = {{0.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, {0.0, 1.0, 0.0}, 45.0};
  EXPECT_GT(look(camera, {0.1, 0.0}).target.x, 0.0);
  EXPECT_LT(look(camera, {0.0, 0.1}).target.y, 0.0);
}

TEST(CameraControl, PanMovesWhatLiesAtTheTargetsDepthWithTheHand) {
  const Camera camera = {{0.0, 0.0, 3.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 60.0};
  // The window shows 2 * 3 * tan(30 degrees) of the target's plane.
  const double height = 6.0 * std::tan(std::acos(-1.0) / 6.0);
  const Camera moved = pan(camera, {0.25, -0.5});
  EXPECT_LT(glm::length(moved.target - glm::dvec3(-0.25 * height, -0.5 * height, 0.0)), 1e-14);
  EXPECT_LT(glm::length(moved.eye - moved.target - glm::dvec3(0.0, 0.0, 3.0)), 1e-14);
}

TEST(CameraControl, DollyNeverReachesTheTarget) {
  for (const Camera& camera : cameras()) {
    Camera moved = camera;
    for (int i = 0; i < 1000; ++i) {
      moved = dolly(moved, 1.0, 2.0);
      ASSERT_NO_THROW(checkCamera(moved, ""));
    }
    // Near the origin the scene's share decides, far from it a million roundings of the coordinates.
    const double nearest = std::max(2.0 * kNearestShare, 1e6 * kRounding * reach(camera));
    EXPECT_NEAR(distanceOf(moved), nearest, 1e-6 * nearest + 2.0 * kRounding * reach(camera));
    EXPECT_EQ(moved.target, camera.target);
    for (int i = 0; i < 1000; ++i) moved = dolly(moved, -1.0, 2.0);
    EXPECT_NEAR(distanceOf(moved), 2.0 * kFarthestShare, 1e-5 * kFarthestShare);
    ASSERT_NO_THROW(checkCamera(moved, ""));
  }
}

TEST(CameraControl, DollyGoesByFactorsOfTheDistance) {
  const Camera camera = cameras()[0];
  ControlSpeeds speeds;
  speeds.dollyFactor = 1.25;
  EXPECT_NEAR(distanceOf(dolly(camera, 2.0, 2.0, speeds)), distanceOf(camera) / (1.25 * 1.25), 1e-14);
  EXPECT_NEAR(distanceOf(dolly(camera, -1.0, 2.0, speeds)), distanceOf(camera) * 1.25, 1e-14);
}

TEST(CameraControl, ZoomEnlargesThePictureAndLeavesTheEye) {
  const Camera camera = cameras()[0];
  ControlSpeeds speeds;
  speeds.zoomFactor = 2.0;
  const Camera moved = zoom(camera, 1.0, speeds);
  EXPECT_EQ(moved.eye, camera.eye);
  EXPECT_EQ(moved.target, camera.target);
  // Sizes in the picture go with 1 / tan(fov / 2).
  EXPECT_NEAR(std::tan(glm::radians(moved.verticalFovDeg) / 2.0),
              std::tan(glm::radians(camera.verticalFovDeg) / 2.0) / 2.0, 1e-15);
  EXPECT_EQ(zoom(camera, 1e4).verticalFovDeg, kNarrowestFovDeg);
  EXPECT_EQ(zoom(camera, -1e4).verticalFovDeg, kWidestFovDeg);
}

TEST(CameraControl, FlyingIsAShareOfTheDiagonalASecondWhateverTheFrameRate) {
  ControlSpeeds speeds;
  speeds.flyShare = 0.5;
  for (const Camera& camera : cameras()) {
    const glm::dvec3 view = camera.target - camera.eye;
    for (const FlyKeys& keys : {FlyKeys{1.0, 0.0, 0.0}, FlyKeys{0.0, -1.0, 0.0}, FlyKeys{0.0, 0.0, 1.0},
                                FlyKeys{1.0, 1.0, 0.0}, FlyKeys{-1.0, 0.0, -1.0}}) {
      const Camera once = fly(camera, keys, 0.5, 2.0, speeds);
      Camera often = camera;
      for (int i = 0; i < 1000; ++i) often = fly(often, keys, 0.0005, 2.0, speeds);
      // Half of a diagonal of 2 for half a second; forward and up are not at right angles, so two keys may be
      // slower, never faster.
      const double way = glm::length(once.eye - camera.eye), near = kRounding * (reach(camera) + 32.0);
      EXPECT_LE(way, 0.5 + near);
      EXPECT_GE(way, 0.25);
      if (std::abs(keys.forward) + std::abs(keys.right) + std::abs(keys.up) == 1.0) {
        EXPECT_NEAR(way, 0.5, near);
      }
      // A thousand steps, each rounded where the eye lies, and by a view that is as far off.
      EXPECT_LE(glm::length(often.eye - once.eye), 1000.0 * near);
      // Eye and target move by one vector: the view is as it was, but for the target's own rounding.
      EXPECT_LE(glm::length(often.target - often.eye - view), 1000.0 * kRounding * 32.0 + near);
    }
  }
  const Camera camera = {{0.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, {0.0, 1.0, 0.0}, 45.0};
  EXPECT_GT(fly(camera, {0.0, 1.0, 0.0}, 1.0, 1.0).eye.x, 0.0);
  EXPECT_GT(fly(camera, {0.0, 0.0, 1.0}, 1.0, 1.0).eye.y, 0.0);
  EXPECT_LT(fly(camera, {1.0, 0.0, 0.0}, 1.0, 1.0).eye.z, 0.0);
}

TEST(CameraControl, FrameAllShowsAllOfTheBoundsAndNotMuchMore) {
  for (const Camera& camera : cameras())
    for (const double aspect : {0.4, 1.0, 2.5}) {
      scene::Bounds bounds;
      bounds.extend(camera.target + glm::dvec3(5.0, -1.0, 2.0));
      bounds.extend(camera.target + glm::dvec3(7.0, 3.0, 2.5));
      const Camera framed = frameAll(camera, bounds, aspect);
      expectUsable(framed, camera);
      EXPECT_EQ(framed.target, bounds.centre());
      EXPECT_LT(glm::length(glm::normalize(framed.target - framed.eye) -
                            glm::normalize(camera.target - camera.eye)),
                1e-9);
      const glm::dvec3 forward = glm::normalize(framed.target - framed.eye),
                       right = glm::normalize(glm::cross(forward, framed.up)),
                       up = glm::cross(right, forward);
      const double slope = std::tan(glm::radians(framed.verticalFovDeg) / 2.0);
      double largest = 0.0;
      for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p = {corner & 1 ? bounds.low.x : bounds.high.x,
                              corner & 2 ? bounds.low.y : bounds.high.y,
                              corner & 4 ? bounds.low.z : bounds.high.z};
        const glm::dvec3 v = p - framed.eye;
        const double depth = glm::dot(v, forward);
        ASSERT_GT(depth, 0.0);
        largest = std::max({largest, std::abs(glm::dot(v, up)) / (depth * slope),
                            std::abs(glm::dot(v, right)) / (depth * slope * aspect)});
      }
      EXPECT_LE(largest, 1.0);
      // A box fills at least 1 / sqrt(3) of its bounding sphere's width in some direction of the picture;
      // seen against the other, wider field of view it fills less.
      EXPECT_GE(largest, 0.2);
    }
  const Camera camera = cameras()[0];
  EXPECT_EQ(frameAll(camera, {}, 1.0).eye, camera.eye);
  scene::Bounds point;
  point.extend({4.0, 5.0, 6.0});
  EXPECT_NEAR(distanceOf(frameAll(camera, point, 1.0)), distanceOf(camera), 1e-14);
}

TEST(CameraControl, ManyRandomStepsLeaveACameraThatTakesPictures) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> size(0.0, 0.5);
  for (const Camera& start : cameras()) {
    Camera camera = start;
    for (int i = 0; i < 10000; ++i) {
      const glm::dvec2 drag(size(random), size(random));
      switch (random() % 6) {
        case 0:
          camera = orbit(camera, drag);
          break;
        case 1:
          camera = look(camera, drag);
          break;
        case 2:
          camera = pan(camera, drag);
          break;
        case 3:
          camera = dolly(camera, 10.0 * drag.x, 2.0);
          break;
        case 4:
          camera = zoom(camera, 10.0 * drag.x);
          break;
        default:
          camera = fly(camera, {drag.x, drag.y, size(random)}, 0.02, 2.0);
      }
      expectUsable(camera, start);
      // Upright: the picture's up is on the side of the up axis.
      ASSERT_GE(polarDeg(camera), kPoleDeg - 1e-3);
      ASSERT_LE(polarDeg(camera), 180.0 - kPoleDeg + 1e-3);
    }
  }
}

TEST(CameraControl, TenThousandDragsWearTheDistanceByTheirRoundingAlone) {
  std::mt19937_64 random(6);
  std::normal_distribution<double> size(0.0, 0.1);
  for (const Camera& start : cameras()) {
    Camera camera = start;
    for (int i = 0; i < 10000; ++i) camera = orbit(camera, {size(random), size(random)});
    EXPECT_EQ(camera.target, start.target);
    EXPECT_NEAR(distanceOf(camera), distanceOf(start),
                10000.0 * kRounding * (reach(start) + 16.0 * distanceOf(start)));
  }
}

}  // namespace
}  // namespace limen::viewer
