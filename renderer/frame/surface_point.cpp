// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/surface_point.h"

namespace limen::frame {

gl::ShaderDefines surfaceDefines(const Frame& frame, bool smoothNormals) {
  const SurfaceBuffers& surface = frame.gpuScene().surface();
  gl::ShaderDefines defines;
  if (smoothNormals && (surface.hasNormals() || surface.hasAttributes())) defines["SMOOTH"] = "1";
  if (surface.hasNormals()) defines["NORMALS"] = "1";
  if (surface.hasAttributes()) defines["ATTRIBUTES"] = "1";
  return defines;
}

void configureSurfacePoints(const gl::Program& program, const Frame& frame, const scene::Camera& seenBy) {
  const glm::dmat4& toCamera = frame.anchorToCamera();
  program.set("anchorToCamera", glm::mat4(toCamera));
  program.set("cameraToAnchor", glm::mat4(glm::inverse(toCamera)));
  program.set("rayScale", glm::vec2(frame.tanHalfFov() * frame.aspect(), frame.tanHalfFov()));
  program.set("sizePx", frame.sizePx());
  program.set("eye", glm::vec3(seenBy.eye - frame.gpuScene().anchor()));
  frame.geometry().bindStorage();
  frame.bindSurfaces();
}

}  // namespace limen::frame
