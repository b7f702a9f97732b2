// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "renderer/frame/surface_buffers.h"
#include "renderer/gl/buffer.h"
#include "renderer/scene/scene.h"

namespace limen::frame {

/// A scene's geometry in GPU memory. Positions are float, relative to the anchor (the centre of the scene's
/// bounds). The scene must outlive it.
class GpuScene {
 public:
  explicit GpuScene(const scene::Scene& scene);
  ~GpuScene();
  GpuScene(const GpuScene&) = delete;
  GpuScene& operator=(const GpuScene&) = delete;

  glm::dvec3 anchor() const { return anchor_; }
  uint32_t triangleCount() const { return triangleCount_; }
  int64_t bytes() const;

  /// Draws all triangles; vertex attribute 0 is the position; gl_PrimitiveID is the triangle's index.
  void draw() const;
  /// Storage blocks as renderer/frame/scene_buffers.glsl declares them: positions, indices, materials.
  void bindStorage(uint32_t firstBinding) const;
  /// Made when first asked for.
  const SurfaceBuffers& surface() const;

 private:
  const scene::Scene& scene_;
  glm::dvec3 anchor_;
  uint32_t triangleCount_, vertexArray_ = 0;
  gl::Buffer positions_, indices_, triangleAlbedo_;
  mutable std::optional<SurfaceBuffers> surface_;
};

}  // namespace limen::frame
