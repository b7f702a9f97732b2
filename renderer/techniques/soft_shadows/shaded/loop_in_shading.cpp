// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/shaded/loop_in_shading.h"

#include <epoxy/gl.h>

#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/soft_shadows/shaded/shaded_bindings.h"
#include "renderer/techniques/soft_shadows/visibility_pass.h"

namespace limen::techniques {
namespace {

constexpr const char *kFolder = "renderer/techniques/soft_shadows/shaded/",
                     *kShadePass = "soft_shadows/shade";

/// "bitmask" of ".../bitmask/bitmask.comp.glsl": its form within shading has the same name.
std::string shaderName(const std::string& path) {
  const size_t start = path.rfind('/') + 1;
  return path.substr(start, path.find('.', start) - start);
}

}  // namespace

LoopInShading::LoopInShading(SearchParts parts, VisibilityLoop stage, const frame::ShadedSetting& shading)
    : stage_(stage),
      shading_(shading),
      shader_(kFolder + shaderName(parts.shader)),
      search_(parts.search, parts.levels, parts.occluders),
      quality_(parts.levels, parts.passes),
      maps_(parts.search.map, parts.maps),
      gathering_(std::move(parts.gathering)) {}

LoopInShading::~LoopInShading() {
  if (vertexArray_ != 0) glDeleteVertexArrays(1, &vertexArray_);
}

void LoopInShading::prepare(frame::Frame& frame) {
  maps_.prepare(frame.scene());
  gl::ShaderDefines defines = search_.defines();
  quality_.define(defines);
  defines.merge(maps_.defines());
  defines.merge(gathering_->prepare(frame, maps_));
  defines.merge(frame::shadingDefines(shading_, frame));
  defines["IN_SHADING"] = "1";
  picture_.emplace(gl::Format::RGBA32F, frame.sizePx());
  int64_t bytes = picture_->bytes();
  gl::ProgramCache& programs = frame.context().programs();
  if (stage_ == VisibilityLoop::Compute) {
    program_ = &programs.compute(shader_ + ".comp.glsl", defines);
  } else {
    program_ =
        &programs.get({std::string(kFolder) + "full_screen.vert.glsl", shader_ + ".frag.glsl"}, defines);
    if (vertexArray_ == 0) glCreateVertexArrays(1, &vertexArray_);
    if (stage_ == VisibilityLoop::Forward) {
      defines["FORWARD"] = "1";
      forward_ = &programs.get({"renderer/frame/triangle_ids.vert.glsl", shader_ + ".frag.glsl"}, defines);
      depth_.emplace(gl::Format::Depth32F, frame.sizePx());
      bytes += depth_->bytes();
    }
    target_.emplace(std::vector<const gl::Texture*>{&*picture_}, depth_ ? &*depth_ : nullptr);
  }
  frame.passes().setBytesHeld(kShadePass, bytes);
}

void LoopInShading::configure(const gl::Program& program, frame::Frame& frame) {
  const frame::ShadowMapSettings& map = maps_.maps()[0];
  const frame::LightFrustum& frustum = search_.bind(frame, {&map, 1}, 0);
  frame::configureShading(program, frame, shading_);
  setMapUniforms(program, frame, frustum, map);
  const glm::dmat4 toLight = frame.scene().lights.at(0).toLightSpace(frame.gpuScene().anchor());
  program.set("cameraToLight", glm::mat4(toLight * glm::inverse(frame.anchorToCamera())));
  search_.configure(program);
  quality_.configure(program);
  gathering_->configure(program, 0);
  frame.get<frame::TriangleIds>().texture().bindTexture(kShadeIdsUnit);
}

void LoopInShading::render(frame::Frame& frame) {
  // Made before the pass begins.
  frame.get<frame::TriangleIds>();
  search_.bind(frame, maps_.mapsOf(0), 0);
  const auto scope = frame.passes().open(kShadePass);
  if (stage_ != VisibilityLoop::Compute) {
    drawFragments(frame);
    return;
  }
  configure(*program_, frame);
  picture_->bindImage(kShadeImage, gl::Access::Write);
  program_->dispatch(frame.sizePx());
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

void LoopInShading::drawFragments(frame::Frame& frame) {
  target_->bind();
  if (forward_) {
    // The background, and pixels where the rasteriser rounded otherwise than the one of the triangle numbers,
    // are still at the far plane after the triangles.
    constexpr GLfloat kFar = 0.0F;
    glClearBufferfv(GL_DEPTH, 0, &kFar);
    configure(*forward_, frame);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_ALWAYS);
    glDisable(GL_CULL_FACE);
    forward_->use();
    forward_->set("anchorToClip", frame::anchorToClip(frame));
    frame.geometry().draw();
    glDepthFunc(GL_EQUAL);
  }
  configure(*program_, frame);
  program_->use();
  glBindVertexArray(vertexArray_);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDisable(GL_DEPTH_TEST);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

}  // namespace limen::techniques
