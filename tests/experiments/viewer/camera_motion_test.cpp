// SPDX-License-Identifier: BSD-3-Clause
// Flying, framing, and long ways of many steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "experiments/viewer/camera_control.h"
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
