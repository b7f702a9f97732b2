// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/gl/buffer.h"
#include "renderer/gl/shader_source.h"
#include "renderer/scene/scene.h"

namespace limen::techniques {

/// Throws Error for techniques that would draw what is trimmed away.
void requireUntrimmed(const scene::Scene& scene);

/// A scene's curved surfaces in GPU memory, as patches.glsl declares them: float, control points homogeneous
/// and relative to the anchor. Points that are equal stay bitwise equal.
class PatchBuffers {
 public:
  /// Throws Error if surfaces are trimmed, unless the technique draws trims.
  PatchBuffers(const scene::Scene& scene, glm::dvec3 anchor, bool drawsTrims = false);
  void bindStorage() const;
  uint32_t count() const { return count_; }
  int64_t bytes() const { return patches_.bytes() + points_.bytes() + normals_.bytes(); }
  /// SHAPE, if all patches have the same; POLYNOMIAL, if all weights are 1.
  const gl::ShaderDefines& defines() const { return defines_; }

 private:
  uint32_t count_;
  gl::Buffer patches_, points_, normals_;
  gl::ShaderDefines defines_;
};

}  // namespace limen::techniques
