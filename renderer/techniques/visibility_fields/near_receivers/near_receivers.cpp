// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/visibility_fields/near_receivers/near_receivers.h"

#include <epoxy/gl.h>

#include <cstddef>

#include "renderer/techniques/visibility_fields/field_pass_bindings.h"

namespace limen::techniques {

static_assert(kNearGroup == kGroupSide * kGroupSide);

void NearReceivers::define(gl::ShaderDefines& defines) const {
  if (!traced()) return;
  defines["FIELD_NEAR"] = "1";
  defines["NEAR_LIST"] = "1";
}

void NearReceivers::prepare(frame::Frame& frame, const std::string& shader,
                            const gl::ShaderDefines& defines) {
  if (!traced()) return;
  gl::ProgramCache& programs = frame.context().programs();
  groups_ = &programs.compute("renderer/techniques/visibility_fields/near_receivers/near_groups.comp.glsl");
  program_ = &programs.compute(shader, defines);
  const int64_t pixels = int64_t{frame.sizePx().x} * frame.sizePx().y;
  list_.emplace(static_cast<int64_t>(sizeof(NearListHeader)) + int64_t{4} * pixels, nullptr);
  list_->clearUint(0);
}

void NearReceivers::bindList(const gl::Program& program) const {
  const auto* near = std::get_if<NearTraced>(&setting_);
  if (!near) return;
  list_->bindStorage(kNearListBuffer);
  program.set("nearFootprints", static_cast<float>(near->footprints));
}

void NearReceivers::makeGroups() const {
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  list_->bindStorage(kNearListBuffer);
  groups_->dispatch({1, 1}, {1, 1});
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

void NearReceivers::dispatch() const {
  program_->use();
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, list_->id());
  glDispatchComputeIndirect(static_cast<GLintptr>(offsetof(NearListHeader, groupsX)));
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

Counter NearReceivers::count(const frame::Frame& frame) const {
  double share = 0.0;
  if (list_) {
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    share = list_->read<NearListHeader>(0, 1)[0].listed / (double(frame.sizePx().x) * frame.sizePx().y);
  }
  return {quantity().name, share};
}

Quantity NearReceivers::quantity() {
  return {"near_share", "Pixels whose rays are traced, being near to an object", "", Direction::LowerIsBetter,
          "bench"};
}

}  // namespace limen::techniques
