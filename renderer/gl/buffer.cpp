// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/gl/buffer.h"

#include <epoxy/gl.h>

#include <utility>

#include "renderer/gl/fills.h"

namespace limen::gl {
Buffer::Buffer(int64_t bytes, const void* data) : bytes_(bytes > 0 ? bytes : 16) {
  glCreateBuffers(1, &id_);
  glNamedBufferStorage(id_, bytes_, bytes > 0 ? data : nullptr, GL_DYNAMIC_STORAGE_BIT);
}

Buffer::~Buffer() {
  if (id_) glDeleteBuffers(1, &id_);
}

Buffer::Buffer(Buffer&& other) noexcept : id_(std::exchange(other.id_, 0)), bytes_(other.bytes_) {}

Buffer& Buffer::operator=(Buffer&& other) noexcept {
  std::swap(id_, other.id_);
  std::swap(bytes_, other.bytes_);
  return *this;
}

void Buffer::bindStorage(uint32_t binding) const { glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, id_); }
void Buffer::bindStorage(uint32_t binding, int64_t offset, int64_t bytes) const {
  glBindBufferRange(GL_SHADER_STORAGE_BUFFER, binding, id_, offset, bytes);
}
void Buffer::bindUniform(uint32_t binding) const { glBindBufferBase(GL_UNIFORM_BUFFER, binding, id_); }

void Buffer::clearUint(uint32_t value) const {
  if (const Fills* fills = Fills::forBytes(bytes_)) return fills->fillBuffer(id_, bytes_, value);
  // After what shaders have written to it before.
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glClearNamedBufferData(id_, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &value);
}

void Buffer::write(int64_t offset, int64_t bytes, const void* data) const {
  uint32_t staging = 0;
  glCreateBuffers(1, &staging);
  glNamedBufferStorage(staging, bytes, data, 0);
  glCopyNamedBufferSubData(staging, id_, 0, offset, bytes);
  glDeleteBuffers(1, &staging);  // takes effect when the copy is done
}

void Buffer::readBytes(int64_t offset, int64_t bytes, void* out) const {
  if (bytes <= 0) return;
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  // From a copy: it seems that NVIDIA's driver moves buffers that the host reads into the host's memory,
  // where shaders are slow to reach them. On an H200 the rounds of recursion/queues, whose counters are read
  // after a frame, take a third of the time with copies.
  const Buffer copy(bytes, nullptr);
  glCopyNamedBufferSubData(id_, copy.id_, offset, 0, bytes);
  glGetNamedBufferSubData(copy.id_, 0, bytes, out);
}

}  // namespace limen::gl
