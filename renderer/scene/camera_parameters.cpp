// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/error.h"
#include "renderer/scene/camera_path_file.h"
#include "renderer/scene/camera_text.h"
#include "renderer/scene/scene.h"

namespace limen::scene {
namespace {

/// The path that `camera` or `camera_path` gives; no keys if neither does.
CameraPath givenPath(const ParameterValues& complete) {
  const std::string &still = complete.text("camera"), &file = complete.text("camera_path");
  if (!still.empty() && !file.empty())
    throw Error("'camera' and 'camera_path' are both given", {}, "give one: a still view or a path");
  if (!still.empty()) return {{{0.0, parseCamera(still)}}};
  if (file.empty()) return {};
  try {
    return readCameraPath(file);
  } catch (const Error& error) {
    // As one message: whoever reports it may have a place of its own, that of the descriptor.
    throw Error(std::string("'camera_path': ") + error.what());
  }
}

}  // namespace

void checkCameraParameters(const ParameterValues& complete) { givenPath(complete); }

CameraPath cameraFor(const CameraPath& built, const ParameterValues& complete) {
  CameraPath path = givenPath(complete);
  if (path.keys.empty()) path = built;
  if (path.keys.size() > 1)
    for (CameraPath::Key& key : path.keys) key.timeS -= complete.real("time_s");
  return path;
}

}  // namespace limen::scene
