// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/gl/buffer.h"
#include "renderer/scene/scene.h"

namespace limen::frame {

/// What shading needs of a scene's surfaces beyond positions: vertex normals and attributes, the material of
/// each triangle, the materials, patches' control points (relative to the anchor). Attributes that no vertex
/// has use no memory.
class SurfaceBuffers {
 public:
  SurfaceBuffers(const scene::Scene& scene, glm::dvec3 anchor);
  /// Storage blocks as renderer/frame/surface_buffers.glsl declares them.
  void bindStorage() const;
  int64_t bytes() const;
  const gl::Buffer& normals() const { return normals_; }  ///< three floats per vertex, if it has any
  bool hasNormals() const { return hasNormals_; }
  bool hasAttributes() const { return hasAttributes_; }

 private:
  bool hasNormals_, hasAttributes_;
  gl::Buffer normals_, attributes_, triangleMaterials_, materials_;
};

}  // namespace limen::frame
