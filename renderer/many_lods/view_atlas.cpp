// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/many_lods/view_atlas.h"

#include <epoxy/gl.h>

#include <string>

#include "experiments/base/error.h"

namespace limen::many_lods {
namespace {

int64_t atlasBytes(uint32_t views, glm::ivec2 tilePx, AtlasForm form) {
  const int64_t bytes = int64_t{views} * tilePx.x * tilePx.y * (form == AtlasForm::Wide ? 8 : 4);
  GLint64 most = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
  if (bytes > most)
    throw Error("the tiles of the views take " + std::to_string(bytes) +
                    " bytes in one buffer; this device allows " + std::to_string(most),
                {}, "use fewer views or smaller tiles");
  return bytes;
}

AtlasForm formFor(AtlasForm form) {
  return form == AtlasForm::Wide && !hasWideAtomics() ? AtlasForm::TwoPasses : form;
}

}  // namespace

gl::ShaderDefines discDefines(Discs discs) {
  if (discs == Discs::Oriented) return {{"ORIENTED", "1"}};
  return {};
}

bool hasWideAtomics() {
  return epoxy_has_gl_extension("GL_NV_shader_atomic_int64") &&
         epoxy_has_gl_extension("GL_ARB_gpu_shader_int64");
}

ViewAtlas::ViewAtlas(gl::Context& context, uint32_t views, glm::ivec2 tilePx, AtlasForm form, Discs discs,
                     bool leavesOwnOut)
    : form_(formFor(form)), tilePx_(tilePx), depths_(atlasBytes(views, tilePx, form_), nullptr) {
  gl::ShaderDefines defines = discDefines(discs);
  if (leavesOwnOut) defines["OWNERS"] = "1";
  defines["FORM"] = std::to_string(static_cast<int>(form_));
  const std::string path = "renderer/many_lods/splat.comp.glsl";
  first_ = &context.programs().compute(path, defines);
  if (form_ == AtlasForm::TwoPasses) {
    gl::ShaderDefines second = defines;
    second["WINNERS"] = "1";
    second_ = &context.programs().compute(path, second);
  }
  if (form_ == AtlasForm::TwoPasses || form_ == AtlasForm::TwoWords)
    winners_.emplace(depths_.bytes(), nullptr);
}

void ViewAtlas::clear() const {
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  depths_.clearUint(kAtlasEmpty);
  if (winners_) winners_->clearUint(kAtlasEmpty);
}

void ViewAtlas::draw(const DrawList& what, const gl::Buffer& nodes, const gl::Buffer& views,
                     const Settings& settings, const gl::Buffer* colours) const {
  clear();
  nodes.bindStorage(kCutNodesBuffer);
  views.bindStorage(kCutViewsBuffer);
  what.list.bindStorage(kCutListBuffer);
  what.control.bindStorage(kCutControlBuffer);
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, what.control.id());
  depths_.bindStorage(kSplatDepthsBuffer);
  if (winners_) winners_->bindStorage(kSplatWinnersBuffer);
  if (colours) colours->bindStorage(kSplatColoursBuffer);
  if (settings.owners) settings.owners->bindStorage(kSplatOwnersBuffer);
  if (settings.cones) settings.cones->bindStorage(kSplatConesBuffer);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
  for (const gl::Program* program : {first_, second_}) {
    if (!program) continue;
    program->set("tilePx", tilePx_);
    program->set("nearest", settings.nearest);
    program->set("radiusScale", settings.radiusScale);
    program->use();
    glDispatchComputeIndirect(offsetof(CutControl, drawX));
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  }
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
}

}  // namespace limen::many_lods
