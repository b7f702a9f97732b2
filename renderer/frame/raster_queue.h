// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "renderer/gl/buffer.h"
#include "renderer/gl/program.h"

namespace limen::frame {

/// Row bands of large triangles that a rasteriser in compute leaves to groups of invocations
/// (RasterQueueHeader, then a uvec2 each). Its count is an indirect dispatch too: an empty queue starts no
/// groups. Shaders set the count back to 0.
class RasterQueue {
 public:
  explicit RasterQueue(int capacity);

  void bindStorage(uint32_t binding) const { buffer_.bindStorage(binding); }
  /// A group for each band, as far as the device starts so many; groups go on until the queue is done. After
  /// a barrier for storage and commands.
  void dispatch(const gl::Program& program) const;
  int64_t bytes() const { return buffer_.bytes(); }

 private:
  gl::Buffer buffer_;
  bool indirect_;
};

}  // namespace limen::frame
