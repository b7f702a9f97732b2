// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace limen::gl {

/// Immutable-size buffer in GPU memory.
class Buffer {
 public:
  /// `data` may be null: contents undefined. Size 0 becomes 16 bytes, since GL has no empty buffers.
  Buffer(int64_t bytes, const void* data);
  template <class T>
  explicit Buffer(const std::vector<T>& data)
      : Buffer(static_cast<int64_t>(data.size() * sizeof(T)), data.data()) {}
  ~Buffer();
  Buffer(Buffer&& other) noexcept;
  Buffer& operator=(Buffer&& other) noexcept;
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;

  uint32_t id() const { return id_; }
  int64_t bytes() const { return bytes_; }
  void bindStorage(uint32_t binding) const;  ///< shader storage block
  /// A part of it; `offset` is a multiple of kStorageAlignment.
  void bindStorage(uint32_t binding, int64_t offset, int64_t bytes) const;
  static constexpr int64_t kStorageAlignment = 256;  // that every implementation allows
  void bindUniform(uint32_t binding) const;
  void clearUint(uint32_t value) const;
  /// In submission order: work submitted earlier still sees the old contents. `bytes` > 0. Uses a copy on the
  /// GPU: with glNamedBufferSubData, NVIDIA's driver 580.159 lets dispatches submitted earlier read the new
  /// contents while several frames are in flight.
  void write(int64_t offset, int64_t bytes, const void* data) const;
  /// Waits for the GPU.
  template <class T>
  std::vector<T> read(int64_t offset = 0, int64_t count = -1) const {
    std::vector<T> out(static_cast<size_t>(count >= 0 ? count : (bytes_ - offset) / int64_t{sizeof(T)}));
    readBytes(offset, static_cast<int64_t>(out.size() * sizeof(T)), out.data());
    return out;
  }

 private:
  void readBytes(int64_t offset, int64_t bytes, void* out) const;
  uint32_t id_ = 0;
  int64_t bytes_ = 0;
};

}  // namespace limen::gl
