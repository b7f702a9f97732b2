// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/gl/texture.h"

namespace limen::techniques {

/// Six square faces in RGBA32F with mip levels, in the order and orientation of OpenGL's cube maps: as an
/// array of layers to write, as a cube map to read, filtered linearly and across edges.
class CubeMap {
 public:
  explicit CubeMap(int resolution, bool mipLevels);
  ~CubeMap();
  CubeMap(const CubeMap&) = delete;
  CubeMap& operator=(const CubeMap&) = delete;

  const gl::Texture& faces() const { return faces_; }
  int resolution() const { return faces_.sizePx().x; }
  int64_t bytes() const { return faces_.bytes(); }
  void bindCube(uint32_t unit) const;
  /// Levels above the finest: each texel the mean of four.
  void makeLevels() const;

 private:
  gl::Texture faces_;
  uint32_t cube_ = 0;
};

/// Middle (forward), right and down of a face: the direction of texel coordinates s, t in [-1, 1] is forward
/// + s right + t down.
struct CubeFace {
  glm::dvec3 forward, right, down;
};
CubeFace cubeFace(int face);

}  // namespace limen::techniques
