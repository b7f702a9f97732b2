// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/path_recorder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "renderer/scene/camera_path_file.h"

namespace limen::viewer {
namespace {

using scene::Camera;
using scene::CameraPath;
using Keys = std::vector<CameraPath::Key>;

/// Every sample within the tolerance, and no inner key that could be left out alone.
void expectReduced(const CameraPath& path, const Keys& samples, const PathTolerance& tolerance) {
  const auto fits = [&](const CameraPath& candidate) {
    for (const auto& [timeS, camera] : samples)
      if (!isWithin(candidate.at(timeS), camera, tolerance)) return false;
    return true;
  };
  EXPECT_TRUE(fits(path));
  EXPECT_EQ(path.keys.front().timeS, samples.front().timeS);
  EXPECT_EQ(path.keys.back().timeS, samples.back().timeS);
  for (size_t i = 1; i + 1 < path.keys.size(); ++i) {
    CameraPath fewer = path;
    fewer.keys.erase(fewer.keys.begin() + static_cast<long>(i));
    EXPECT_FALSE(fits(fewer)) << "key " << i;
  }
}

/// Round a target while climbing, with a pause and a sudden start: 10 s at 60 pictures a second.
Keys flight(glm::dvec3 origin) {
  Keys out;
  for (int i = 0; i <= 600; ++i) {
    const double t = i / 60.0, moving = t < 4.0 ? t : std::max(4.0, t - 2.0);
    out.push_back(
        {t, Camera{origin + glm::dvec3(3.0 * std::sin(moving), 0.5 * moving, 3.0 * std::cos(moving)),
                   origin,
                   {0.0, 1.0, 0.0},
                   45.0 + (t > 8.0 ? 5.0 * (t - 8.0) : 0.0)}});
  }
  return out;
}

TEST(ReducedPath, ReproducesSamplesWithFarFewerKeys) {
  for (const glm::dvec3 origin : {glm::dvec3(0.0), glm::dvec3(1e6)})
    for (const double position : {1e-2, 1e-3, 1e-4}) {
      const PathTolerance tolerance = {position, 1e-3, 1e-2};
      const Keys samples = flight(origin);
      const CameraPath path = reducedPath(samples, tolerance);
      expectReduced(path, samples, tolerance);
      EXPECT_LT(path.keys.size(), samples.size() / 5) << position;
    }
}

TEST(ReducedPath, FollowsUniformMotionWithItsEnds) {
  Keys samples;
  for (int i = 0; i <= 100; ++i)
    samples.push_back({0.1 * i, Camera{{0.3 * i, 1.0, 0.0}, {0.3 * i, 0.0, 5.0}}});
  EXPECT_EQ(reducedPath(samples).keys.size(), 2U);
}

TEST(ReducedPath, KeepsAllSamplesOfAMotionWithoutRule) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  Keys samples;
  for (int i = 0; i < 60; ++i)
    samples.push_back({i / 60.0, Camera{{place(random), place(random), 4.0}, {place(random), 0.0, 0.0}}});
  expectReduced(reducedPath(samples), samples, {});
}

TEST(ReducedPath, OneOrTwoSamplesAreThePath) {
  EXPECT_TRUE(reducedPath({}).keys.empty());
  EXPECT_EQ(reducedPath({{2.0, Camera{}}}).keys.size(), 1U);
  EXPECT_EQ(reducedPath({{2.0, Camera{}}, {3.0, Camera{}}}).keys.size(), 2U);
}

TEST(PathRecorder, TakesSamplesAtItsIntervalsAndTheLastCamera) {
  PathRecorder recorder(0.1);
  // 60 pictures a second from an odd start: every sixth is a sample.
  for (int i = 0; i <= 62; ++i)
    recorder.add(1234.5 + i / 60.0, Camera{{0.01 * i, 0.0, 5.0}, glm::dvec3(0.0)});
  const Keys samples = recorder.samples();
  ASSERT_EQ(samples.size(), 12U);
  for (size_t i = 0; i < 11; ++i) {
    // Differences of times near 1234 have its rounding, 2.3e-13.
    EXPECT_NEAR(samples[i].timeS, 0.1 * static_cast<double>(i), 1e-12);
    EXPECT_EQ(samples[i].camera.eye.x, 0.01 * static_cast<double>(6 * i));
  }
  EXPECT_NEAR(samples[11].timeS, 62.0 / 60.0, 1e-12);
  EXPECT_EQ(samples[0].timeS, 0.0);
}

TEST(PathRecorder, LeavesOutTimesThatDoNotAscend) {
  PathRecorder recorder(0.1);
  EXPECT_TRUE(recorder.samples().empty());
  EXPECT_TRUE(recorder.path().keys.empty());
  for (const double t : {1.0, 1.5, 1.5, 0.2, std::nan(""), 2.0}) recorder.add(t, Camera{});
  EXPECT_EQ(recorder.samples().size(), 3U);
}

TEST(PathRecorder, WhatItRecordedIsAPathForAFile) {
  PathRecorder recorder(1.0 / 30.0);
  for (const auto& [timeS, camera] : flight(glm::dvec3(10.0))) recorder.add(7.0 + timeS, camera);
  const CameraPath path = recorder.path();
  const CameraPath read = scene::parseCameraPath(toYaml(path), "p.yaml");
  for (const auto& [timeS, camera] : recorder.samples()) EXPECT_TRUE(isWithin(read.at(timeS), camera, {}));
}

}  // namespace
}  // namespace limen::viewer
