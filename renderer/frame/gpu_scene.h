// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <optional>

#include "renderer/frame/surface_buffers.h"
#include "renderer/frame/triangle_ranges.h"
#include "renderer/gl/buffer.h"
#include "renderer/scene/scene.h"

namespace limen::ray_tracing {
class RayScene;
}

namespace limen::gl {
class Context;
}

namespace limen::frame {

/// A scene's geometry in GPU memory, all levels of detail included. Positions are float, relative to the
/// anchor (the centre of the scene's bounds). Vertices and triangles are numbered through Scene::mesh and on
/// through Scene::coarser. The scene must outlive it.
class GpuScene {
 public:
  explicit GpuScene(const scene::Scene& scene);
  ~GpuScene();
  GpuScene(const GpuScene&) = delete;
  GpuScene& operator=(const GpuScene&) = delete;

  glm::dvec3 anchor() const { return anchor_; }
  double diagonal() const { return diagonal_; }  ///< of the scene's bounds
  double reach() const { return reach_; }        ///< largest finite coordinate relative to the anchor
  /// Of the scene with all objects at their finest level.
  uint32_t triangleCount() const { return triangleCount_; }
  uint32_t vertexCount() const { return vertexCount_; }  ///< of all levels
  int64_t bytes() const;

  /// Draws `ranges`, or the finest scene. Vertex attribute 0 is the position, attribute 1 the number of the
  /// draw's first triangle: it and gl_PrimitiveID sum to the triangle's number. `positions`, if given,
  /// replaces the vertices' positions (same layout).
  void draw(const TriangleRanges* ranges = nullptr, const gl::Buffer* positions = nullptr) const;
  /// Storage blocks as renderer/frame/scene_buffers.glsl declares them: positions, indices.
  void bindStorage(const gl::Buffer* positions = nullptr) const;
  const gl::Buffer& positions() const { return positions_; }  ///< three floats per vertex
  const gl::Buffer& indices() const { return indices_; }  ///< three words per triangle, finest scene first
  /// Made on first use.
  const SurfaceBuffers& surface() const;
  /// The finest scene's triangles, for tracing rays. Made on first use, then kept. Throws Error if the device
  /// cannot hold it, or parts of the scene move.
  const ray_tracing::RayScene& rays(gl::Context& context) const;

 private:
  const scene::Scene& scene_;
  glm::dvec3 anchor_;
  double diagonal_, reach_;
  uint32_t triangleCount_, vertexCount_, vertexArray_ = 0;
  gl::Buffer positions_, indices_, firstTriangle_;
  mutable std::optional<SurfaceBuffers> surface_;
  mutable std::unique_ptr<ray_tracing::RayScene> rays_;
};

/// What is drawn of a scene: chosen triangles, and where their vertices are.
struct Geometry {
  // A whole scene is a geometry.
  Geometry(const GpuScene& whole) : scene(&whole) {}
  Geometry(const GpuScene& of, const TriangleRanges* chosen, const gl::Buffer* moved)
      : scene(&of), ranges(chosen), positions(moved) {}

  const GpuScene* scene;
  const TriangleRanges* ranges = nullptr;  ///< null: the finest scene
  const gl::Buffer* positions = nullptr;   ///< null: as the scene has them

  uint32_t triangleCount() const { return ranges ? ranges->triangleCount() : scene->triangleCount(); }
  void draw() const { scene->draw(ranges, positions); }
  void bindStorage() const { scene->bindStorage(positions); }
};

}  // namespace limen::frame
