// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "renderer/frame/compute_raster.h"
#include "renderer/frame/frame.h"
#include "renderer/frame/frame_bindings.h"
#include "renderer/gl/texture.h"

namespace limen::frame {

/// View from a point of the light's plane along the light's direction, in tangents: texel coordinate u in
/// [0,1] of a map looks along x/z = low.x + u (high.x - low.x). Rows grow with y.
struct LightFrustum {
  glm::dvec2 offset{0.0};           ///< the eye on the light's plane, light space
  glm::dvec2 low{-1.0}, high{1.0};  ///< tangents at the map's edges
  double near = 1e-3;               ///< light-space z of the near plane; anything nearer is not seen
  bool castersCut = false;  ///< some casters lie outside, more than 75 degrees off the light's direction
  glm::dmat4 clipFromLight() const;  ///< reversed depth, infinite far plane: depth = near / z
};

/// Casters of a scene in the space of its first light, from which frusta are fitted.
class LightCasters {
 public:
  /// Only `part` of Scene::parts, if not negative.
  explicit LightCasters(const scene::Scene& scene, int part = -1);
  /// Smallest frustum that sees all casters (parts that are not receiverOnly) in front of the light from
  /// `offset`, with a margin of one texel of a map with `resolution`. Directions are limited to 75 degrees
  /// from the light's direction, the near plane to 1/1000 of the farthest caster: nearer occluders are
  /// clipped.
  LightFrustum fit(glm::dvec2 offset, int resolution) const;

 private:
  std::vector<glm::dvec3> vertices_;  // three a triangle
  double farthest_ = 0.0;
};

/// Depth image of the scene from a point of the light: near / z, 0 where it is empty.
class ShadowRaster {
 public:
  /// What else a texel stores, or how its surface is chosen.
  enum class Extra {
    None,
    Ids,   ///< which triangle each texel sees
    Peels  ///< the nearest surface behind another image of the same frustum
  };
  ShadowRaster(gl::Context& context, int resolution, Raster raster, Extra extra = Extra::None);
  /// `geometry`: usually the frame's. `peel` if and only if the raster was made to peel.
  void draw(Frame& frame, const Geometry& geometry, const LightFrustum& frustum,
            const DepthPeel& peel = {}) const;
  /// One channel of 32-bit float, to be read by texelFetch.
  const gl::Texture& depth() const { return hardware_ ? hardware_->depth : compute_->depth(); }
  const gl::Texture& ids() const { return hardware_ ? *hardware_->ids : compute_->ids(); }  ///< R32UI
  int64_t bytes() const;

 private:
  struct HardwareTarget {
    const gl::Program& program;
    gl::Texture depth;
    std::optional<gl::Texture> ids;
    gl::Framebuffer framebuffer;
  };
  std::unique_ptr<HardwareTarget> hardware_;
  std::unique_ptr<ComputeRaster> compute_;
};

/// Which of the maps that one light can have. Source: Schwarz 2009, section 4.2.2.
struct ShadowMapSettings {
  int resolution = 1024;  ///< texels per side; a power of two
  Raster raster = Raster::Auto;
  glm::dvec2 eye{0.5};     ///< the point that the map is seen from, unit light coordinates
  int layer = 0;           ///< number of surfaces peeled off: the map shows what lies behind them
  double peelBias = 1e-5;  ///< smallest relative distance at which something counts as behind a surface
  /// Extent of the frustum as a share of the fitted one, around the direction of the light's axis or the
  /// nearest direction within the fitted frustum.
  double extent = 1.0;
  int part = -1;  ///< of Scene::parts: only this part is in the map; -1: the whole scene
  /// Number of layers, this one among them, that are read together: their textures are layers of common
  /// arrays. 1: textures of its own.
  int together = 1;
  std::string key() const {
    return std::to_string(resolution) + "/" + std::to_string(int(raster)) + name() +
           (together > 1 ? "/of_" + std::to_string(together) : "");
  }
  /// The first of the layers that are read together; none if this is the first, or the only one.
  std::optional<ShadowMapSettings> first() const;
  /// The same map with textures of its own.
  ShadowMapSettings alone() const;
  /// What distinguishes the map from the usual one in pass names: "" or "/layer_1", "/part_2",
  /// "/eye_0.25_0.75".
  std::string name() const;
};

/// A texture of a shadow map or of what is made from it. Layers that are read together share an array; `own`
/// is this layer's part of it.
class MapTexture {
 public:
  /// `layers`: of this map alone, as for gl::Texture. `first`: that of the first layer of those read
  /// together; null: this is the first, or the only one.
  MapTexture(gl::Format format, glm::ivec2 sizePx, int levels, int layers, const ShadowMapSettings& map,
             const MapTexture* first);
  const gl::Texture& own() const { return own_; }
  /// What is bound to read the map: the array, from the first of the layers that are read together.
  const gl::Texture& shared() const { return all_ ? *all_ : own_; }

 private:
  std::optional<gl::Texture> all_;
  gl::Texture own_;
};

/// One view, as specified by the settings.
class ShadowDepth : public FrameInput {
 public:
  static constexpr const char* kName = "shadow_depth";
  ShadowDepth(Frame& frame, ShadowMapSettings settings);
  void make(Frame& frame) override;
  const gl::Texture& depth() const { return raster_.depth(); }
  const LightFrustum& frustum() const { return frustum_; }

 private:
  ShadowMapSettings settings_;
  ShadowRaster raster_;
  LightFrustum frustum_;
  std::unique_ptr<TriangleRanges> part_;  // null: the whole scene
  std::string pass_;
};

/// Linear shadow map, light-space z of the nearest surface; kEmptyDepth where the map is empty: R32F.
class ShadowMap : public FrameInput {
 public:
  static constexpr const char* kName = "shadow_map";
  ShadowMap(Frame& frame, ShadowMapSettings settings);
  void make(Frame& frame) override;
  const gl::Texture& texture() const { return linear_; }
  const LightFrustum& frustum() const { return frustum_; }

 private:
  ShadowMapSettings settings_;
  const gl::Program& program_;
  gl::Texture linear_;
  LightFrustum frustum_;
  std::string pass_;
};

/// Hierarchical shadow map (HSM): minimum and maximum of z over 2^i x 2^i texels. The thesis (section 4.1)
/// keeps both in one two-channel texture; here they are two, because the loop over micro-occluders reads the
/// minimum alone and the maximum of level 0 is never needed: 6.7 MB instead of 10.7 MB at 1024 x 1024.
class MinMaxPyramid : public FrameInput {
 public:
  static constexpr const char* kName = "min_max_pyramid";
  MinMaxPyramid(Frame& frame, ShadowMapSettings settings);
  void make(Frame& frame) override;
  const gl::Texture& minimum() const { return minima_.own(); }  ///< R32F, level 0 is the linear shadow map
  /// R32F, its level i is the pyramid's level i + 1.
  const gl::Texture& maximum() const { return maxima_.own(); }
  const gl::Texture& sharedMinimum() const { return minima_.shared(); }  ///< as for MapTexture
  const gl::Texture& sharedMaximum() const { return maxima_.shared(); }
  const LightFrustum& frustum() const { return frustum_; }
  int levels() const { return minimum().levels(); }

 private:
  ShadowMapSettings settings_;
  const gl::Program &first_, &next_;
  MapTexture minima_, maxima_;
  LightFrustum frustum_;
  std::string pass_;
};

}  // namespace limen::frame
