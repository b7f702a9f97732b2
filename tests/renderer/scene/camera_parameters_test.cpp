// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "renderer/scene/camera_path_file.h"
#include "renderer/scene/camera_text.h"
#include "renderer/scene/placement.h"
#include "tests/renderer/scene/scene_fixtures.h"

namespace limen::scene {
namespace {

using fixtures::build;
using fixtures::Given;
using testing::HasSubstr;

const std::string kView = "eye 3.1 1.7 4.2 target 0.1 0.3 -0.2 up 0.1 1 0 fov 38.5";

ParameterValues complete(const std::string& scene, const Given& given) {
  return {SceneRegistry::instance().get(scene).allParameters(), given};
}

void expectSamePath(const CameraPath& a, const CameraPath& b) {
  ASSERT_EQ(a.keys.size(), b.keys.size());
  EXPECT_EQ(std::memcmp(a.keys.data(), b.keys.data(), a.keys.size() * sizeof(CameraPath::Key)), 0);
  EXPECT_EQ(a.runIn, b.runIn);
}

std::string sceneRefusal(const Given& given) {
  try {
    build("columns_hall", given);
  } catch (const Error& error) {
    return error.what();
  }
  return "taken";
}

TEST(CameraParameters, AGivenViewIsTheScenesAndNothingElseChanges) {
  // In place of a still view and of a path alike.
  for (const char* motion : {"still", "walk"}) {
    const Scene own = build("columns_hall", {{"motion", std::string(motion)}});
    const Scene given =
        build("columns_hall", {{"motion", std::string(motion)}, {"camera", "view"}, {"camera.text", kView}});
    expectSamePath(given.camera, {{{0.0, parseCamera(kView)}}});
    EXPECT_FALSE(given.traits().count("moving_camera"));
    EXPECT_EQ(given.mesh.positions, own.mesh.positions);
    EXPECT_EQ(given.lights[0].centre, own.lights[0].centre);
    EXPECT_NE(given.contentHash(), own.contentHash());
  }
}

TEST(CameraParameters, AGivenViewIsInUnitsOfTheBuiltWorld) {
  const Scene moved =
      build("columns_hall", {{"camera", "view"}, {"camera.text", kView}, {"scale", 3.0}, {"offset", 10.0}});
  expectSamePath(moved.camera, {{{0.0, parseCamera(kView)}}});
}

TEST(CameraParameters, WhatABuiltScenesCameraSaysGivesTheSameScene) {
  // Far from the origin, where a rounded number would show.
  const Given far = {{"offset", 1e6}, {"scale", 1.0 / 3.0}};
  const Scene own = build("columns_hall", far);
  Given given = far;
  setCamera(given, StillView{toText(own.camera.at(0.0))});
  EXPECT_EQ(build("columns_hall", given).contentHash(), own.contentHash());
}

TEST(CameraParameters, APathFromAFileReplacesTheScenesAndTimeMovesAlongIt) {
  const fixtures::TemporaryFolder folder;
  const std::string file = folder.path() + "/walk.yaml";
  const Scene walk = build("columns_hall", {{"motion", std::string("walk")}});
  writeCameraPath(file, walk.camera);
  expectSamePath(build("columns_hall", {{"camera", "path"}, {"camera.file", file}}).camera, walk.camera);
  const Scene later =
      build("columns_hall", {{"camera", "path"}, {"camera.file", file}, {"camera.time_s", 2.7}});
  expectSamePath(later.camera,
                 build("columns_hall", {{"motion", std::string("walk")}, {"camera.time_s", 2.7}}).camera);
  EXPECT_TRUE(later.traits().count("moving_camera"));
}

TEST(CameraParameters, CameraForGivesTheVeryPathOfABuiltScene) {
  const fixtures::TemporaryFolder folder;
  const std::string file = folder.path() + "/walk.yaml";
  writeCameraPath(file, build("columns_hall", {{"motion", std::string("walk")}, {"scale", 0.7}}).camera);
  const Given world = {{"motion", std::string("walk")}, {"scale", 1.1}, {"offset", 1e3}};
  const CameraPath built = build("columns_hall", world).camera;
  for (const Given& chosen :
       {Given{}, Given{{"camera.time_s", 1.0 / 3.0}}, Given{{"camera.time_s", 3600.0}},
        Given{{"camera", "view"}, {"camera.text", kView}}, Given{{"camera", "path"}, {"camera.file", file}},
        Given{{"camera", "path"}, {"camera.file", file}, {"camera.time_s", 0.1}}}) {
    Given all = world;
    all.insert(chosen.begin(), chosen.end());
    const CameraChoice camera = PlacementSettings::table().read(complete("columns_hall", all)).camera;
    expectSamePath(cameraFor(built, camera), build("columns_hall", all).camera);
  }
}

TEST(CameraParameters, RefuseBadOnes) {
  EXPECT_THAT(sceneRefusal({{"camera", "view"}, {"camera.text", std::string("walk")}}),
              HasSubstr("camera 'walk': 'walk' where eye"));
  EXPECT_THAT(sceneRefusal({{"camera", "view"}, {"camera.text", std::string("eye 0 0 1 target 0 0 1")}}),
              HasSubstr("same point"));
  EXPECT_THAT(sceneRefusal({{"camera", "path"}, {"camera.file", std::string("/nowhere/p.yaml")}}),
              HasSubstr("camera.file: /nowhere/p.yaml: no such file"));
  const fixtures::TemporaryFolder folder;
  const std::string file = folder.write("bad.yaml", "camera_path:\n  - {time_s: 0}\n");
  EXPECT_THAT(sceneRefusal({{"camera", "path"}, {"camera.file", file}}), HasSubstr("bad.yaml:2:5: 'eye'"));
  const SceneInfo& info = SceneRegistry::instance().get("columns_hall");
  const auto check = [&](const std::string& view) {
    info.checkValues(complete("columns_hall", {{"camera", "view"}, {"camera.text", view}}));
  };
  EXPECT_THROW(check("walk"), Error);
  EXPECT_NO_THROW(check(kView));
}

TEST(CameraParameters, AViewHasNeitherAFileNorATime) {
  EXPECT_THAT(
      sceneRefusal({{"camera", "view"}, {"camera.text", kView}, {"camera.file", std::string("a.yaml")}}),
      HasSubstr("'camera.file' belongs to another choice"));
  EXPECT_THAT(sceneRefusal({{"camera", "view"}, {"camera.text", kView}, {"camera.time_s", 1.0}}),
              HasSubstr("'camera.time_s' belongs to another choice"));
  EXPECT_THAT(sceneRefusal({{"camera.text", kView}}), HasSubstr("it exists with camera: view"));
}

TEST(CameraParameters, SetCameraReplacesAnyOther) {
  Given given = {
      {"camera", "path"}, {"camera.file", std::string("a.yaml")}, {"camera.time_s", 3.0}, {"scale", 2.0}};
  setCamera(given, StillView{kView});
  EXPECT_EQ(given, (Given{{"camera", "view"}, {"camera.text", kView}, {"scale", 2.0}}));
  clearCamera(given);
  EXPECT_EQ(given, (Given{{"scale", 2.0}}));
}

}  // namespace
}  // namespace limen::scene
