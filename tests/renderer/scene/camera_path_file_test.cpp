// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/camera_path_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "experiments/base/yaml_tree.h"
#include "tests/renderer/scene/scene_fixtures.h"

namespace limen::scene {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string pathRefusal(const std::string& text) {
  try {
    parseCameraPath(text, "p.yaml");
  } catch (const Error& error) {
    return error.what();
  }
  return "taken";
}

CameraPath somePath() {
  return {{{-0.0, {{1e6 + 1e-10, 1.0 / 3.0, -0.0}, {1e6, 5e-324, 1.0}, {0.0, 1.0, 1e-3}, 45.0}},
           {0.1, {{0.1, 0.2, 0.3}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 0.01}},
           // A cut.
           {0.1, {{5.1, 0.2, 0.3}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 179.0}},
           {1e9, {{0.1, 0.2, 0.3}, {0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, 60.0}}}};
}

void expectSameBits(const CameraPath& a, const CameraPath& b) {
  static_assert(sizeof(CameraPath::Key) == 11 * sizeof(double), "keys are compared without padding");
  ASSERT_EQ(a.keys.size(), b.keys.size());
  EXPECT_EQ(std::memcmp(a.keys.data(), b.keys.data(), a.keys.size() * sizeof(CameraPath::Key)), 0);
}

TEST(CameraPathFile, ReadsBackToTheSameDoubles) {
  expectSameBits(parseCameraPath(toYaml(somePath()), "p.yaml"), somePath());
}

TEST(CameraPathFile, WritesWhatItReads) {
  const fixtures::TemporaryFolder folder;
  const std::string file = folder.path() + "/walk.yaml";
  writeCameraPath(file, somePath());
  expectSameBits(readCameraPath(file), somePath());
}

TEST(CameraPathFile, APathThatNobodyCouldReadReplacesNothing) {
  const fixtures::TemporaryFolder folder;
  const std::string file = folder.path() + "/walk.yaml";
  writeCameraPath(file, somePath());
  CameraPath bad = somePath();
  bad.keys[1].camera.target = bad.keys[1].camera.eye;
  EXPECT_THROW(writeCameraPath(file, bad), Error);
  EXPECT_THROW(writeCameraPath(file, CameraPath{}), Error);
  expectSameBits(readCameraPath(file), somePath());
  // Nor is anything left beside it.
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(CameraPathFile, UpAndFieldOfViewMayBeLeftOut) {
  const CameraPath path =
      parseCameraPath("camera_path:\n  - {time_s: 2, eye: [0, 0, 5], target: [0, 0, 0]}\n", "p.yaml");
  ASSERT_EQ(path.keys.size(), 1U);
  EXPECT_EQ(path.keys[0].timeS, 2.0);
  EXPECT_EQ(path.keys[0].camera.up, Camera{}.up);
  EXPECT_EQ(path.keys[0].camera.verticalFovDeg, Camera{}.verticalFovDeg);
}

TEST(CameraPathFile, SaysAllThatIsWrongWithItsLines) {
  EXPECT_THAT(pathRefusal("camera_path:\n"
                          "  - {time_s: 0, eye: [0, 0, 5], target: [0, 0, 0], tilt: 3}\n"
                          "  - {time_s: nan, eye: [0, 0, 5], target: [0, 0, 0]}\n"
                          "  - {time_s: 2, eye: [0, .inf, 5], target: [0, 0]}\n"
                          "  - {time_s: 3, eye: [0, 0, 5]}\n"
                          "  - {time_s: 4, eye: [0, 0, 5], target: [0, 0, 5]}\n"
                          "  - {time_s: 5, eye: [0, 0, 5], target: [0, 0, 0], fov_deg: 0}\n"),
              AllOf(HasSubstr("p.yaml:2:52: unknown key 'tilt'"), HasSubstr("p.yaml:3:14: 'time_s' is 'nan'"),
                    HasSubstr("p.yaml:4:"), HasSubstr("'eye' is '.inf'"), HasSubstr("'target' is a list"),
                    HasSubstr("p.yaml:5:5: 'target'"), HasSubstr("p.yaml:6:5: camera"),
                    HasSubstr("same point"), HasSubstr("p.yaml:7:5: camera"), HasSubstr("0.01 to 179")));
}

TEST(CameraPathFile, TimesAscend) {
  const auto key = [](const char* time) {
    return std::string("  - {time_s: ") + time + ", eye: [0, 0, 5], target: [0, 0, 0]}\n";
  };
  EXPECT_THAT(pathRefusal("camera_path:\n" + key("1") + key("0.5")),
              HasSubstr("p.yaml:3:5: time_s 0.5 comes after 1"));
  EXPECT_EQ(pathRefusal("camera_path:\n" + key("1") + key("1") + key("2")), "taken");
  EXPECT_THAT(pathRefusal("camera_path:\n" + key("1") + key("1") + key("1")),
              HasSubstr("p.yaml:4:5: a third key"));
}

TEST(CameraPathFile, RefusesWhatIsNoPath) {
  for (const char* text : {"", "- 1\n", "camera_path:\n", "camera_path: []\n", "camera_path: 3\n",
                           "camera_paths: []\n", "camera_path: [3]\n"})
    EXPECT_THAT(pathRefusal(text), HasSubstr("p.yaml:1:")) << text;
  EXPECT_THROW(readCameraPath("/nowhere/p.yaml"), Error);
}

}  // namespace
}  // namespace limen::scene
