// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/frame.h"

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace limen::frame {

Frame::Frame(gl::Context& context, const scene::Scene& scene, const GpuScene& gpuScene, glm::ivec2 sizePx,
             double timeS)
    : context_(context),
      scene_(scene),
      gpuScene_(gpuScene),
      sizePx_(sizePx),
      camera_(scene.camera.at(timeS)) {
  // Everything is taken relative to the anchor before it becomes float, so distance from the origin costs no
  // precision.
  const glm::dvec3 anchor = gpuScene.anchor();
  anchorToCamera_ = glm::lookAt(camera_.eye - anchor, camera_.target - anchor, camera_.up);
  tanHalfFov_ = glm::tan(0.5 * glm::radians(camera_.verticalFovDeg));
}

void Frame::begin() {
  ++number_;
  passes_.beginFrame();
}

void Frame::end() { passes_.endFrame(); }

}  // namespace limen::frame
