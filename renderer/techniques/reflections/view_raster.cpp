// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/reflections/view_raster.h"

#include <epoxy/gl.h>

#include <array>

#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/reflections/reflection_bindings.h"

namespace limen::techniques {
namespace {

gl::ShaderDefines viewDefines(bool masked, ViewRaster::Shown shown) {
  using Shown = ViewRaster::Shown;
  gl::ShaderDefines defines;
  if (masked) defines["MASKED"] = "1";
  if (shown == Shown::BackFaces) defines["BACK_FACES"] = "1";
  if (shown == Shown::FrontsBehindDepth) defines["FRONTS_BEHIND_DEPTH"] = "1";
  return defines;
}

}  // namespace

ViewRaster::ViewRaster(frame::Frame& frame, glm::ivec2 sizePx, const std::vector<uint32_t>& groups,
                       bool masked, Shown shown)
    : program_(frame.context().programs().get({"renderer/techniques/reflections/view_raster.vert.glsl",
                                               "renderer/techniques/reflections/view_raster.frag.glsl"},
                                              viewDefines(masked, shown))),
      ids_(gl::Format::R32UI, sizePx),
      depth_(gl::Format::Depth32F, sizePx),
      framebuffer_({&ids_}, &depth_),
      groups_(groups) {}

void ViewRaster::clear() const {
  framebuffer_.bind();
  constexpr std::array<GLuint, 4> kNothing = {frame::TriangleIds::kNone, 0, 0, 0};
  constexpr GLfloat kFar = 0.0F;
  glClearBufferuiv(GL_COLOR, 0, kNothing.data());
  glClearBufferfv(GL_DEPTH, 0, &kFar);
}

void ViewRaster::draw(const frame::Frame& frame, const glm::mat4& anchorToClip, glm::vec4 clipPlane,
                      uint32_t leftOut, const gl::Texture* image, uint32_t wanted) const {
  framebuffer_.bind();
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  glDisable(GL_CULL_FACE);
  glEnable(GL_CLIP_DISTANCE0);
  program_.use();
  program_.set("anchorToClip", anchorToClip);
  program_.set("clipPlane", clipPlane);
  // Views of cube maps are left-handed, and turn windings round.
  const glm::mat4 rows = glm::transpose(anchorToClip);
  const bool leftHanded =
      glm::dot(glm::cross(glm::vec3(rows[0]), glm::vec3(rows[1])), glm::vec3(rows[3])) > 0.0F;
  program_.set("leftHanded", leftHanded ? 1 : 0);
  program_.set("leftOut", leftOut);
  program_.set("wanted", wanted);
  groups_.bindStorage(kViewGroupsBuffer);
  if (image) image->bindTexture(kViewImageUnit);
  frame.geometry().draw();
  glDisable(GL_CLIP_DISTANCE0);
  glDisable(GL_DEPTH_TEST);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

}  // namespace limen::techniques
