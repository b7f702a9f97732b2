// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/viewed_scene.h"

#include "experiments/base/error.h"
#include "experiments/base/interrupt.h"
#include "renderer/scene/placement.h"

namespace limen::viewer {
namespace {

/// The scene's settings without those that move its camera.
ParameterValues stillValues(const experiments::Configuration& scene) {
  std::map<std::string, ParameterValue> still = scene.values.all();
  scene::setCamera(still, scene::BuiltInCamera());
  return {scene::SceneRegistry::instance().get(scene.name).allParameters(), still};
}

/// The renderer's thread takes errors alone; the signal itself ends the program.
scene::Scene built(const experiments::Configuration& scene) {
  try {
    return scene::buildScene(scene.name, stillValues(scene));
  } catch (const Interrupted&) {
    throw Error("stopped by a signal");
  }
}

}  // namespace

std::string ViewedScene::keyOf(const experiments::Configuration& scene) {
  return scene.name + stillValues(scene).toJson().dump();
}

bool ViewedScene::show(const experiments::Configuration& scene) {
  const bool build = needsBuilding(scene);
  if (build) {
    onGpu_.reset();
    onGpu_ = std::make_unique<frame::SceneOnGpu>(built(scene));
    built_ = onGpu_->scene.camera;
    key_ = keyOf(scene);
  }
  // Exactly the steps that building takes, so that a sweep has the same camera to the last bit.
  const scene::CameraChoice camera = scene::PlacementSettings::table().read(scene.values).camera;
  onGpu_->scene.camera = scene::cameraFor(built_, camera);
  path_ = onGpu_->scene.camera;
  for (scene::CameraPath::Key& key : path_.keys) key.timeS += scene::timeOf(camera);
  return build;
}

}  // namespace limen::viewer
