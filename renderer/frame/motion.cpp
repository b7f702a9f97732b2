// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/motion.h"

#include <epoxy/gl.h>

#include <glm/gtc/matrix_transform.hpp>
#include <string>

#include "experiments/base/text.h"
#include "renderer/frame/frame_bindings.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/frame/moved_vertices.h"

namespace limen::frame {

std::string MotionSetting::key() const { return shortestNumber(dtS); }

Motion::Motion(Frame& frame, MotionSetting setting)
    : setting_(std::move(setting)),
      program_(frame.context().programs().compute(
          "renderer/frame/motion.comp.glsl",
          frame.moved() ? gl::ShaderDefines{{"MOVING", "1"}} : gl::ShaderDefines{})),
      displacement_(gl::Format::RG32F, frame.sizePx()),
      previousDepth_(gl::Format::R32F, frame.sizePx()) {
  frame.passes().setBytesHeld("frame/motion", displacement_.bytes() + previousDepth_.bytes());
}

void Motion::setParts(const Frame& frame, const glm::dmat4& nowToThen) const {
  frame.moved()->motionOf().bindStorage(kMotionOfVerticesBuffer);
  const glm::dmat4 worldToCamera = glm::translate(frame.anchorToCamera(), -frame.gpuScene().anchor());
  const std::vector<scene::PartMotion>& motions = frame.scene().motions;
  for (size_t i = 0; i < motions.size(); ++i) {
    const glm::dmat4 now = motions[i].at(frame.timeS()), then = motions[i].at(frame.timeS() - setting_.dtS);
    const glm::dmat4 part =
        now == then ? nowToThen
                    : nowToThen * worldToCamera * then * glm::inverse(now) * glm::inverse(worldToCamera);
    program_.set(("partNowToThen[" + std::to_string(i) + "]").c_str(), glm::mat4(part));
  }
}

void Motion::make(Frame& frame) {
  const gl::Texture& ids = frame.get<TriangleIds>().texture();
  const auto scope = frame.passes().open("frame/motion");
  const scene::Camera now = frame.camera(), then = frame.scene().camera.at(frame.timeS() - setting_.dtS);
  // Both views relative to the current eye: a still camera then gives exactly the identity, wherever it is.
  const auto view = [&](const scene::Camera& camera) {
    return glm::lookAt(camera.eye - now.eye, camera.target - now.eye, camera.up);
  };
  const bool still = now.eye == then.eye && now.target == then.target && now.up == then.up;
  const glm::dmat4 nowToThen = still ? glm::dmat4(1.0) : view(then) * glm::inverse(view(now));
  const double tanThen = glm::tan(0.5 * glm::radians(then.verticalFovDeg));
  program_.set("anchorToCamera", glm::mat4(frame.anchorToCamera()));
  program_.set("nowToThen", glm::mat4(nowToThen));
  program_.set("rayScale", glm::vec2(frame.tanHalfFov() * frame.aspect(), frame.tanHalfFov()));
  program_.set("rayScaleThen", glm::vec2(tanThen * frame.aspect(), tanThen));
  program_.set("sizePx", frame.sizePx());
  ids.bindTexture(kMotionIdsUnit);
  displacement_.bindImage(kMotionDisplacementImage, gl::Access::Write);
  previousDepth_.bindImage(kMotionPreviousDepthImage, gl::Access::Write);
  frame.geometry().bindStorage();
  if (frame.moved()) setParts(frame, nowToThen);
  program_.dispatch(frame.sizePx());
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

}  // namespace limen::frame
