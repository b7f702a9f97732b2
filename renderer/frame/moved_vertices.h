// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "renderer/gl/buffer.h"
#include "renderer/gl/context.h"
#include "renderer/scene/part_motion.h"

namespace limen::frame {

/// Vertices of a scene whose parts move (scene/part_motion.h), where they are at a time: made on the GPU from
/// where they rest.
class MovedVertices {
 public:
  /// `positions`, `normals`: three floats a vertex, at rest, positions relative to `anchor`; normals may be
  /// null. Both must outlive it. `motionOf`: for each vertex 0 or 1 + the number of its motion. Until the
  /// first update() all rest. Throws Error if there are more than kMostMotions motions.
  MovedVertices(gl::Context& context, std::vector<scene::PartMotion> motions, glm::dvec3 anchor,
                const gl::Buffer& positions, const gl::Buffer* normals,
                const std::vector<uint32_t>& motionOf);

  /// Dispatches; nothing waits. Storage buffers 0 to 4 are bound anew.
  void update(double timeS) const;

  /// A word a vertex: 0, or 1 + the number of its motion.
  const gl::Buffer& motionOf() const { return motionOf_; }
  const gl::Buffer& positions() const { return positions_; }
  const gl::Buffer* normals() const { return normals_ ? &*normals_ : nullptr; }
  int64_t bytes() const;

 private:
  std::vector<scene::PartMotion> motions_;
  glm::dvec3 anchor_;
  uint32_t count_;
  const gl::Buffer& restPositions_;
  const gl::Buffer* restNormals_;
  gl::Buffer motionOf_, positions_;
  std::optional<gl::Buffer> normals_;
  const gl::Program& program_;
};

}  // namespace limen::frame
