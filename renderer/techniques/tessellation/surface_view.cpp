// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/tessellation/surface_view.h"

#include "renderer/frame/g_buffer.h"

namespace limen::techniques {

surfaces::SurfaceView viewOf(const frame::Frame& frame) {
  // Rows of the rotation are the camera's axes.
  const glm::dmat4 axes = glm::transpose(glm::dmat4(glm::dmat3(frame.anchorToCamera())));
  surfaces::SurfaceView out;
  out.eye = frame.camera().eye;
  out.right = glm::dvec3(axes[0]);
  out.up = glm::dvec3(axes[1]);
  out.forward = -glm::dvec3(axes[2]);
  out.tanHalf = {frame.tanHalfFov() * frame.aspect(), frame.tanHalfFov()};
  out.pxAtDistance = frame.sizePx().y / (2.0 * frame.tanHalfFov());
  out.nearest = frame::nearPlane(frame);
  return out;
}

}  // namespace limen::techniques
