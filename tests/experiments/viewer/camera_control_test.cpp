// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/camera_control.h"

#include <gtest/gtest.h>

#include <cmath>

#include "renderer/scene/camera_text.h"
#include "tests/experiments/viewer/control_fixture.h"

namespace limen::viewer {
namespace {

using fixtures::cameras;
using fixtures::distanceOf;
using fixtures::expectUsable;
using fixtures::kRounding;
using fixtures::polarDeg;
using fixtures::reach;
using scene::Camera;

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

}  // namespace
}  // namespace limen::viewer
