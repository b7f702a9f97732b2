// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "renderer/gl/buffer.h"
#include "renderer/scene/scene.h"

namespace limen::frame {

/// A choice of a scene's triangles in GPU memory: what a frame draws. Changing it writes a few bytes a range
/// and no geometry. Frames in flight keep the choice that they were given.
class TriangleRanges {
 public:
  explicit TriangleRanges(size_t capacity);
  TriangleRanges(const TriangleRanges&) = delete;
  TriangleRanges& operator=(const TriangleRanges&) = delete;
  /// Drawn in ascending order of triangles; neighbours become one. Empty ranges are dropped.
  void set(std::vector<scene::TriangleRange> ranges);

  int rangeCount() const { return rangeCount_; }
  uint32_t triangleCount() const { return triangleCount_; }
  /// uvec2 a range: first triangle, and how many triangles all ranges up to and with this one have. Also the
  /// source of the instanced vertex attribute that tells a draw its first triangle.
  const gl::Buffer& ranges() const { return ranges_; }
  /// Indexed indirect draws, one a range; base instance i in draw i.
  const gl::Buffer& commands() const { return commands_; }

 private:
  int rangeCount_ = 0;
  uint32_t triangleCount_ = 0;
  size_t capacity_;
  gl::Buffer ranges_, commands_;
};

}  // namespace limen::frame
