// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/reflections/ray_hierarchy/host_buffers.h"

#include <epoxy/gl.h>

namespace limen::techniques {
namespace {

constexpr int kCopies = 4;

}  // namespace

HostBuffer::HostBuffer(int64_t bytes) : bytes_(bytes) {
  glCreateBuffers(1, &id_);
  glNamedBufferStorage(id_, bytes, nullptr,
                       GL_CLIENT_STORAGE_BIT | GL_MAP_READ_BIT | GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT |
                           GL_MAP_COHERENT_BIT);
}

HostBuffer::~HostBuffer() { glDeleteBuffers(1, &id_); }

void HostBuffer::bindStorage(uint32_t binding) const {
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, id_);
}

LateReadback::LateReadback(int64_t bytes) : bytes_(bytes), slots_(kCopies) {
  constexpr GLbitfield kFlags = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
  for (Slot& slot : slots_) {
    glCreateBuffers(1, &slot.buffer);
    glNamedBufferStorage(slot.buffer, bytes_, nullptr, kFlags | GL_CLIENT_STORAGE_BIT);
    slot.mapped = glMapNamedBufferRange(slot.buffer, 0, bytes_, kFlags);
  }
}

LateReadback::~LateReadback() {
  for (const Slot& slot : slots_) {
    if (slot.fence) glDeleteSync(static_cast<GLsync>(slot.fence));
    glDeleteBuffers(1, &slot.buffer);
  }
}

void LateReadback::copy(const gl::Buffer& from, uint64_t tag) {
  for (Slot& slot : slots_) {
    if (slot.fence) continue;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glCopyNamedBufferSubData(from.id(), slot.buffer, 0, 0, bytes_);
    slot.fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    slot.tag = tag;
    return;
  }
}

const void* LateReadback::take(uint64_t& tag) {
  const Slot* newest = nullptr;
  for (Slot& slot : slots_) {
    if (!slot.fence) continue;
    const GLenum state = glClientWaitSync(static_cast<GLsync>(slot.fence), 0, 0);
    if (state != GL_ALREADY_SIGNALED && state != GL_CONDITION_SATISFIED) continue;
    glDeleteSync(static_cast<GLsync>(slot.fence));
    slot.fence = nullptr;
    if (!newest || slot.tag > newest->tag) newest = &slot;
  }
  if (!newest) return nullptr;
  tag = newest->tag;
  return newest->mapped;
}

}  // namespace limen::techniques
