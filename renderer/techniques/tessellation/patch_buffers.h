// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "renderer/gl/buffer.h"
#include "renderer/gl/shader_source.h"
#include "renderer/scene/scene.h"

namespace limen::techniques {

/// What a technique can draw besides whole surfaces at rest.
struct DrawnSurfaces {
  bool trimmed = false, moving = false;
};
/// Throws Error if the scene has more: it would be drawn whole, or at rest.
void requireDrawn(const scene::Scene& scene, const DrawnSurfaces& drawn = {});

/// A scene's curved surfaces in GPU memory, as patches.glsl declares them: float, control points homogeneous
/// and relative to the anchor. Points that are equal stay bitwise equal.
class PatchBuffers {
 public:
  /// Throws Error as requireDrawn() does.
  PatchBuffers(const scene::Scene& scene, glm::dvec3 anchor, const DrawnSurfaces& drawn = {});
  void bindStorage() const;
  uint32_t count() const { return count_; }
  uint32_t pointCount() const { return pointCount_; }
  /// PointMotion of each control point, where the scene's surfaces move; null elsewhere. The points are then
  /// undefined until move_points.comp.glsl has run.
  const gl::Buffer* motions() const { return motions_ ? &*motions_ : nullptr; }
  int64_t bytes() const {
    return patches_.bytes() + points_.bytes() + normals_.bytes() + (motions_ ? motions_->bytes() : 0);
  }
  /// SHAPE, if all patches have the same; POLYNOMIAL, if all weights are 1.
  const gl::ShaderDefines& defines() const { return defines_; }

 private:
  uint32_t count_, pointCount_;
  gl::Buffer patches_, points_, normals_;
  std::optional<gl::Buffer> motions_;
  gl::ShaderDefines defines_;
};

}  // namespace limen::techniques
