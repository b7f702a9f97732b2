// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "renderer/gl/buffer.h"
#include "renderer/scene/scene.h"

namespace limen::frame {

/// A choice of a scene's triangles in GPU memory: what a frame draws. Changing it writes a few bytes a range
/// and no geometry.
///
/// Frames in flight keep the choice that they were given: what is new goes to a place that the GPU is done
/// with and is copied by the GPU in its turn. Written directly (glNamedBufferSubData), it is seen too early:
/// NVIDIA's driver 580.159 lets dispatches submitted before read it while several frames are under way.
class TriangleRanges {
 public:
  explicit TriangleRanges(size_t capacity);
  ~TriangleRanges();
  TriangleRanges(const TriangleRanges&) = delete;
  TriangleRanges& operator=(const TriangleRanges&) = delete;
  /// Drawn in ascending order of triangles; neighbours become one. Empty ranges are dropped. Waits only if
  /// the GPU is eight changes behind.
  void set(std::vector<scene::TriangleRange> ranges);

  int rangeCount() const { return rangeCount_; }
  uint32_t triangleCount() const { return triangleCount_; }
  /// uvec2 a range: first triangle, and how many triangles all ranges up to and with this one have. Also the
  /// source of the instanced vertex attribute that tells a draw its first triangle.
  const gl::Buffer& ranges() const { return ranges_; }
  /// Indexed indirect draws, one a range; base instance i in draw i.
  const gl::Buffer& commands() const { return commands_; }

 private:
  struct Stage {
    std::optional<gl::Buffer> data;
    void* done = nullptr;  ///< fence behind the copy from it
  };
  int rangeCount_ = 0;
  uint32_t triangleCount_ = 0;
  size_t capacity_;
  gl::Buffer ranges_, commands_;
  std::array<Stage, 8> stages_;
  size_t nextStage_ = 0;
};

}  // namespace limen::frame
