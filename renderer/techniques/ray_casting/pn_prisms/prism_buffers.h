// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/gl/buffer.h"
#include "renderer/scene/scene.h"

namespace limen::techniques {

/// A scene's Bézier triangles and the prisms around them in GPU memory.
class PrismBuffers {
 public:
  /// Each triangle as 4^level parts. Throws Error if a patch is no polynomial triangle of degree 3 at most.
  PrismBuffers(const scene::Scene& scene, glm::dvec3 anchor, int level);
  ~PrismBuffers();
  PrismBuffers(const PrismBuffers&) = delete;
  PrismBuffers& operator=(const PrismBuffers&) = delete;

  /// Draws all prisms with the program in use, whose vertex shader is prism.vert.glsl: the sides turned to
  /// the eye
  /// (`front`) or away from it.
  void draw(bool front) const;
  int64_t prisms() const { return prisms_; }
  int64_t bytes() const { return triangles_.bytes() + vertices_.bytes() + indices_.bytes(); }

 private:
  struct Made;
  explicit PrismBuffers(const Made& made);
  static Made make(const scene::Scene& scene, glm::dvec3 anchor, int level);

  int64_t prisms_;
  gl::Buffer triangles_, vertices_, indices_;
  uint32_t vertexArray_ = 0;
};

}  // namespace limen::techniques
