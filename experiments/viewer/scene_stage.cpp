// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/scene_stage.h"

#include "renderer/scene/placement.h"

namespace limen::viewer {
namespace {

/// What the scene is without what moves its camera.
ParameterValues stillValues(const experiments::Choice& scene) {
  std::map<std::string, ParameterValue> still = scene.values.all();
  scene::setCamera(still, scene::BuiltInCamera());
  return {scene::SceneRegistry::instance().get(scene.name).allParameters(), still};
}

}  // namespace

std::string SceneStage::keyOf(const experiments::Choice& scene) {
  return scene.name + stillValues(scene).toJson().dump();
}

bool SceneStage::choose(const experiments::Choice& scene) {
  const bool build = needsBuilding(scene);
  if (build) {
    stage_.reset();
    stage_ = std::make_unique<experiments::Stage>(scene::buildScene(scene.name, stillValues(scene)));
    built_ = stage_->scene.camera;
    key_ = keyOf(scene);
  }
  // The very steps that building takes, so that a sweep has the same camera to the last bit.
  const scene::CameraChoice camera = scene::PlacementSettings::table().read(scene.values).camera;
  stage_->scene.camera = scene::cameraFor(built_, camera);
  path_ = stage_->scene.camera;
  for (scene::CameraPath::Key& key : path_.keys) key.timeS += scene::timeOf(camera);
  return build;
}

}  // namespace limen::viewer
