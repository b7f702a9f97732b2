// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "renderer/gl/buffer.h"
#include "renderer/scene/scene.h"

namespace limen::frame {

/// A selection of a scene's triangles in GPU memory: what a frame draws. Changing it writes a few bytes per
/// range and no geometry. Frames in flight keep their selection.
class TriangleRanges {
 public:
  explicit TriangleRanges(size_t capacity);
  TriangleRanges(const TriangleRanges&) = delete;
  TriangleRanges& operator=(const TriangleRanges&) = delete;
  /// Drawn in ascending order of triangles; adjacent ranges are merged. Empty ranges are dropped.
  void set(std::vector<scene::TriangleRange> ranges);

  int rangeCount() const { return rangeCount_; }
  uint32_t triangleCount() const { return triangleCount_; }
  /// uvec2 per range: first triangle, and number of triangles in all ranges up to and including this one.
  /// Also the source of the instanced vertex attribute that gives a draw its first triangle.
  const gl::Buffer& ranges() const { return ranges_; }
  /// Indexed indirect draws, one per range; base instance i in draw i.
  const gl::Buffer& commands() const { return commands_; }

 private:
  int rangeCount_ = 0;
  uint32_t triangleCount_ = 0;
  size_t capacity_;
  gl::Buffer ranges_, commands_;
};

}  // namespace limen::frame
