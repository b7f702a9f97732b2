// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "renderer/scene/scene.h"

namespace limen::scene {
namespace {

CameraPath::Key key(double timeS, glm::dvec3 eye, glm::dvec3 target = glm::dvec3(0.0), double fov = 45.0) {
  return {timeS, Camera{eye, target, {0.0, 1.0, 0.0}, fov}};
}

bool finite(const Camera& camera) {
  const glm::dvec3 sum = camera.eye + camera.target + camera.up;
  return std::isfinite(sum.x + sum.y + sum.z + camera.verticalFovDeg);
}

const CameraPath kUneven = {{key(0.0, {0.0, 0.0, 5.0}, {1.0, 0.0, 0.0}, 40.0),
                             key(0.5, {1.0, 2.0, 4.0}, {0.0, 1.0, 0.0}),
                             key(3.0, {-2.0, 1.0, 3.0}, {0.0, 0.0, 1.0}, 50.0), key(3.2, {-2.5, 0.0, 2.0}),
                             key(7.0, {4.0, 4.0, 4.0}, {1.0, 1.0, 1.0}, 30.0)}};

TEST(CameraPath, InterpolatesItsKeys) {
  for (const CameraPath::Key& expected : kUneven.keys) {
    const Camera camera = kUneven.at(expected.timeS);
    EXPECT_NEAR(glm::length(camera.eye - expected.camera.eye), 0.0, 1e-12);
    EXPECT_NEAR(glm::length(camera.target - expected.camera.target), 0.0, 1e-12);
    EXPECT_NEAR(camera.verticalFovDeg, expected.camera.verticalFovDeg, 1e-12);
  }
  EXPECT_EQ(kUneven.durationS(), 7.0);
}

TEST(CameraPath, IsContinuousInPositionAndVelocity) {
  constexpr double kStep = 1e-6;
  for (size_t i = 1; i + 1 < kUneven.keys.size(); ++i) {
    const double t = kUneven.keys[i].timeS;
    const glm::dvec3 before = kUneven.at(t - kStep).eye, at = kUneven.at(t).eye,
                     after = kUneven.at(t + kStep).eye;
    // One-sided differences of a C1 curve differ by its acceleration times the step (about 1e2 here).
    EXPECT_NEAR(glm::length((after - at) / kStep - (at - before) / kStep), 0.0, 2e-3) << i;
  }
}

TEST(CameraPath, FollowsUniformMotionExactlyWhateverTheKeyTimes) {
  CameraPath path;
  for (const double t : {0.0, 0.1, 2.0, 2.5, 9.0}) path.keys.push_back(key(t, {t, 2.0 * t, -t}));
  for (double t = 0.0; t <= 9.0; t += 0.05)
    EXPECT_NEAR(glm::length(path.at(t).eye - glm::dvec3(t, 2.0 * t, -t)), 0.0, 1e-12) << t;
}

TEST(CameraPath, FollowsAParabolaBetweenInnerKeys) {
  // A cubic with the right end points and end velocities is the parabola itself; the inner keys' velocities
  // come from the parabola through three neighbours.
  CameraPath path;
  for (const double t : {0.0, 1.0, 1.5, 4.0, 5.0}) path.keys.push_back(key(t, {t * t, 0.0, 1.0}));
  for (double t = 1.0; t <= 4.0; t += 0.05) EXPECT_NEAR(path.at(t).eye.x, t * t, 1e-11) << t;
}

TEST(CameraPath, RestsBeforeItsFirstAndAfterItsLastKey) {
  EXPECT_EQ(kUneven.at(-1.0).eye, kUneven.keys.front().camera.eye);
  EXPECT_EQ(kUneven.at(100.0).eye, kUneven.keys.back().camera.eye);
  EXPECT_EQ(kUneven.at(std::numeric_limits<double>::quiet_NaN()).eye, kUneven.keys.front().camera.eye);
}

TEST(CameraPath, WithARunInMovesBeforeItsFirstKeyAsItDoesThere) {
  CameraPath path = {{key(0.0, {1.0, 0.0, 5.0}), key(2.0, {5.0, 0.0, 5.0})}, true};
  // Two keys are a straight line at constant speed, here 2 a second.
  EXPECT_NEAR(path.at(-0.25).eye.x, 0.5, 1e-12);
  EXPECT_EQ(path.at(0.0).eye, glm::dvec3(1.0, 0.0, 5.0));
  EXPECT_EQ(path.at(std::numeric_limits<double>::quiet_NaN()).eye, glm::dvec3(1.0, 0.0, 5.0));
  EXPECT_EQ(path.at(-std::numeric_limits<double>::infinity()).eye, glm::dvec3(1.0, 0.0, 5.0));
  path.keys.pop_back();
  EXPECT_EQ(path.at(-1.0).eye, glm::dvec3(1.0, 0.0, 5.0));
}

TEST(CameraPath, OneKeyIsAStillCamera) {
  const CameraPath path = {{key(2.0, {1.0, 2.0, 3.0})}};
  for (const double t : {-5.0, 2.0, 8.0}) EXPECT_EQ(path.at(t).eye, glm::dvec3(1.0, 2.0, 3.0));
  EXPECT_EQ(path.durationS(), 0.0);
  EXPECT_TRUE(finite(CameraPath{}.at(0.0)));
}

TEST(CameraPath, StaysFiniteAndStillWhereKeysRepeat) {
  const CameraPath still = {
      {key(0.0, {1e6, 2.0, 3.0}), key(1.0, {1e6, 2.0, 3.0}), key(4.0, {1e6, 2.0, 3.0})}};
  for (double t = -0.5; t < 4.5; t += 0.01) EXPECT_EQ(still.at(t).eye, glm::dvec3(1e6, 2.0, 3.0)) << t;
  // Two keys at one time: a cut.
  const CameraPath cut = {{key(0.0, {0.0, 0.0, 1.0}), key(1.0, {0.0, 0.0, 2.0}), key(1.0, {5.0, 0.0, 2.0}),
                           key(2.0, {5.0, 0.0, 3.0})}};
  for (double t = -0.5; t < 2.5; t += 0.01) EXPECT_TRUE(finite(cut.at(t))) << t;
  EXPECT_NEAR(cut.at(0.5).eye.x, 0.0, 1e-12);
  EXPECT_NEAR(cut.at(1.0).eye.x, 5.0, 1e-12);
  EXPECT_NEAR(cut.at(1.5).eye.x, 5.0, 1e-12);
  const CameraPath allAtOnce = {{key(1.0, {0.0, 0.0, 1.0}), key(1.0, {1.0, 0.0, 1.0})}};
  EXPECT_TRUE(finite(allAtOnce.at(1.0)));
}

TEST(CameraPath, OppositeUpVectorsNeverCancel) {
  CameraPath path = {{key(0.0, {0.0, 0.0, 1.0}), key(1.0, {0.0, 0.0, 2.0})}};
  path.keys[1].camera.up = {0.0, -1.0, 0.0};
  for (double t = 0.0; t <= 1.0; t += 0.125) EXPECT_GT(glm::length(path.at(t).up), 1e-6) << t;
}

}  // namespace
}  // namespace limen::scene
