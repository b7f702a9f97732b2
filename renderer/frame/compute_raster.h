// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "experiments/base/enum_names.h"
#include "renderer/frame/gpu_scene.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/context.h"
#include "renderer/gl/texture.h"

namespace limen::frame {

/// How triangles become pixels. Both see the same pixel centres and differ only where an edge passes within
/// rounding of one.
enum class Raster {
  Auto,      ///< whichever was measured to be faster, see chosenRaster()
  Hardware,  ///< the driver's rasteriser
  Compute    ///< ComputeRaster
};
constexpr EnumNames<Raster, 3> enumNames(Raster) {
  return {{{{Raster::Auto, "auto"}, {Raster::Compute, "compute"}, {Raster::Hardware, "hardware"}}}};
}

/// Auto resolved: Compute on a GPU, Hardware on a software renderer. On an NVIDIA H200 a shadow map of 72,000
/// triangles takes 0.11 ms in compute and 0.55 ms with the driver's rasteriser at 1024 x 1024, 0.27 ms
/// and 1.26 ms at 2048 x 2048; on llvmpipe compute is many times slower.
Raster chosenRaster(Raster raster, const gl::Context& context);

/// Depth peeling: keeps what lies behind another depth image of the same view (Everitt 2001).
struct DepthPeel {
  const gl::Texture* previous = nullptr;  ///< near / distance, 0: nothing there, and nothing behind
  double bias = 0.0;  ///< smallest extra distance of what is kept, as a share of the distance
};

/// Triangles that the GPU has made: three indices each.
struct ListedTriangles {
  const gl::Buffer &vertices, &indices;
  const gl::Buffer& count;  ///< RasterCount (frame_bindings.h)
  int64_t most;             ///< for which there is room
};

/// How ComputeRaster finds the triangle that each pixel sees.
enum class TriangleSearch {
  Auto,       ///< Packed where the device can (GL_NV_shader_atomic_int64)
  TwoPasses,  ///< the depths of all triangles, then the triangle of that depth, the first of several
  Packed      ///< at once, by atomic operations on depth and index in 64 bits; the same result
};

class ComputeRaster;

struct ComputeRasterSettings {
  bool ids = false;    ///< which triangle each pixel sees as well
  bool peels = false;  ///< draw() is given what to peel off
  TriangleSearch search = TriangleSearch::Auto;
  /// Above 0: for drawListed() alone, with so many floats a vertex, of which the first three are its
  /// position.
  int listedVertexWords = 0;
  /// False: the caller's own pass reads what was gathered from the buffers, see bindGathered().
  bool textures = true;
  /// Gathers into the pixels of another one in place of its own, both packed and without textures: of all
  /// triangles each pixel sees the nearest, of the same depth the other one's, then the first. Its own
  /// triangles' numbers have kSharedRasterTag. At most one shares with each.
  const ComputeRaster* sharesWith = nullptr;
};

/// Rasterises a scene's triangles in compute shaders, into a depth image of near / z (reversed, 0: nothing)
/// and, if asked, the index of the triangle that each pixel sees (0xffffffff: none). Perspective views
/// without a far plane.
///
/// Each pixel's coverage and depth come from the vertices shifted to that pixel, q_i = (x_i, y_i) - pixel *
/// w_i in clip space: the signs of q_j x q_k say inside or outside, and these products are the barycentric
/// weights of the point seen. Triangles that share an edge compute it from the same numbers, so there are no
/// cracks; there is no clipping, since a triangle that reaches behind the eye needs none. Two-dimensional
/// homogeneous rasterisation is due to Olano and Greer 1997. A few invocations share a small triangle, unless
/// there are many; large ones are cut into bands of rows for groups, which visit no more of a row than the
/// triangle can cover.
class ComputeRaster {
 public:
  ComputeRaster(gl::Context& context, glm::ivec2 sizePx, const ComputeRasterSettings& settings = {});

  /// `clip` maps positions relative to the scene's anchor to clip space with z = near, w = distance.
  void draw(const Geometry& geometry, const glm::mat4& clip, double near, const DepthPeel& peel = {}) const;
  /// The host need not know how many there are. One invocation a triangle.
  void drawListed(const ListedTriangles& triangles, const glm::mat4& clip, double near) const;

  /// draw() and drawListed() in two steps, for packed ones without textures that peel nothing. Neither issues
  /// a barrier, so that other work runs beside them: the second step needs one for shader storage after the
  /// first, and what reads the pixels one after the second.
  enum class Step { Small, Large };
  void drawStep(const Geometry& geometry, const glm::mat4& clip, double near, Step step) const;
  void drawListedStep(const ListedTriangles& triangles, const glm::mat4& clip, double near, Step step) const;

  const gl::Texture& depth() const { return *depth_; }  ///< R32F
  const gl::Texture& ids() const { return *ids_; }      ///< R32UI
  /// For a pass in place of textures: it must leave depths and queue 0 and ids 0xffffffff, as it finds them
  /// where there is nothing (gathered_raster.glsl).
  struct GatheredBindings {
    uint32_t depths, ids, queue;  ///< `ids` is not bound if depth and index are packed
  };
  void bindGathered(const GatheredBindings& bindings) const;
  /// Of packed ones: pixels and queues in one buffer of uvec2. The pass must leave 0 the pixels and, at both
  /// places, the queues' headers.
  void bindPixels(uint32_t binding) const { pixels_->bindStorage(binding); }
  glm::uvec2 queuePlaces() const;
  bool packed() const { return packed_; }
  int64_t bytes() const;
  static bool canPack();  ///< of the current context

 private:
  /// Of small triangles that invocations share, and of those of one invocation each.
  using Programs = std::array<const gl::Program*, 2>;
  /// All passes; `small` dispatches one of the programs that it is given over all triangles.
  template <class Small>
  void run(const glm::mat4& clip, double near, const Small& small) const;
  void dispatchSmall(const Programs& small, uint32_t triangleCount) const;
  void dispatchListed(const gl::Program& program, const ListedTriangles& triangles) const;
  void bindTargets() const;
  void setView(const glm::mat4& clip, double near) const;
  void setTriangles(const Geometry& geometry, const DepthPeel& peel) const;
  template <class Action>
  void forAll(const Action& action) const;

  void finish() const;

  glm::ivec2 sizePx_;
  bool packed_;
  /// With the indices if they are packed.
  Programs smallDepth_;
  Programs smallIds_ = {};
  const gl::Program &largeDepth_, &finish_, &requeue_;
  const gl::Program* largeIds_ = nullptr;
  std::optional<gl::Texture> depth_, ids_;
  /// Depths, packed: 64 bits a pixel; behind them the queue, and that of one that shares the pixels.
  std::shared_ptr<gl::Buffer> pixels_;
  int64_t queueAt_;
  std::optional<gl::Buffer> idBits_;
};

}  // namespace limen::frame
