// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/gl/buffer.h"

namespace limen::techniques {

/// A storage buffer in the CPU's memory, as far as the driver heeds the wish.
class HostBuffer {
 public:
  explicit HostBuffer(int64_t bytes);
  ~HostBuffer();
  HostBuffer(const HostBuffer&) = delete;
  HostBuffer& operator=(const HostBuffer&) = delete;
  void bindStorage(uint32_t binding) const;
  int64_t bytes() const { return bytes_; }

 private:
  uint32_t id_ = 0;
  int64_t bytes_;
};

/// The contents of a buffer as some earlier frame left them, without ever waiting for the GPU: copies into
/// memory that the CPU can read, each with a fence.
class LateReadback {
 public:
  explicit LateReadback(int64_t bytes);
  ~LateReadback();
  LateReadback(const LateReadback&) = delete;
  LateReadback& operator=(const LateReadback&) = delete;

  /// Queues a copy of the first bytes of `from`; nothing if all copies are still under way.
  void copy(const gl::Buffer& from, uint64_t tag);
  /// The newest copy that is done and was not taken yet, with its tag; null: none.
  const void* take(uint64_t& tag);

 private:
  struct Slot {
    uint32_t buffer = 0;
    const void* mapped = nullptr;
    void* fence = nullptr;  // GLsync
    uint64_t tag = 0;
  };
  int64_t bytes_;
  std::vector<Slot> slots_;
};

}  // namespace limen::techniques
