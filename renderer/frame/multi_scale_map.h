// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "renderer/frame/shadow_map.h"

namespace limen::frame {

/// Which 2^i x 2^i texels the entry (x, y) of layer i covers, along each axis and clipped to the map.
enum class WindowAnchor {
  Centre,  ///< [x - 2^(i-1), x + 2^(i-1) - 1]: multi-scale shadow map (MSSM), Schwarz 2009, section 4.3.1
  Corner   ///< [x, x + 2^i - 1]: N-buffer (Décoret 2005)
};

/// Smallest and largest depth of every square of 2, 4, 8, ... texels, at any position: an array of layers
/// that all have the map's resolution. Layer 0 is the map itself and not stored; layer i of the texture is
/// the structure's layer i + 1. Both bounds are read together, so they share texels: RG32F (minimum,
/// maximum).
class MultiScaleLayers {
 public:
  /// `resolution` is a power of two; `map` and `first` as for MapTexture. Throws Error if the device has no
  /// room for them.
  MultiScaleLayers(gl::Context& context, int resolution, WindowAnchor anchor,
                   const ShadowMapSettings& map = {}, const MultiScaleLayers* first = nullptr);
  /// `minimum` and `maximum` are those of a MinMaxPyramid, `level` is its level of this resolution.
  void build(const gl::Texture& minimum, const gl::Texture& maximum, int level) const;
  /// log2(resolution) layers; for a map of one texel, one layer that repeats it.
  const gl::Texture& texture() const { return texture_.own(); }
  /// As for MapTexture: the layers of one map behind those of another.
  const gl::Texture& shared() const { return texture_.shared(); }
  int layers() const { return layers_; }

 private:
  /// Several layers a dispatch.
  void buildByTiles() const;
  /// All layers in two dispatches, of a small map.
  void buildByLines() const;

  int resolution_, layers_;
  WindowAnchor anchor_;
  bool byLines_;
  const gl::Program &first_, &next_;
  MapTexture texture_;
};

struct MultiScaleSettings {
  ShadowMapSettings map;
  /// Resolution of the layers, at most the map's. Below it they are built on the pyramid's level of that
  /// size, and both together are a hybrid Y shadow map (YSM; Schwarz 2009, section 4.3.2).
  int base = 1024;
  WindowAnchor anchor = WindowAnchor::Centre;
  /// Those of the first of the maps that are read together; none if this is the first, or the only one.
  std::optional<MultiScaleSettings> first() const {
    const auto of = map.first();
    return of ? std::optional(MultiScaleSettings{*of, base, anchor}) : std::nullopt;
  }
  std::string key() const {
    return map.key() + "/" + std::to_string(base) + (anchor == WindowAnchor::Corner ? "/corner" : "/centre");
  }
};

/// Layers over a MinMaxPyramid, in their own pass. The pyramid's time and memory are in its pass: a
/// micro-occluder of a coarse level is read there. The thesis's MSSM needs no pyramid for that, since every
/// 2^i-th entry of its layer i is one of the pyramid's texels; the values are the same, but here they are
/// closer together in memory.
class MultiScaleMap : public FrameInput {
 public:
  static constexpr const char* kName = "multi_scale_map";
  MultiScaleMap(Frame& frame, MultiScaleSettings settings);
  void make(Frame& frame) override;
  const gl::Texture& texture() const { return layers_.texture(); }
  const gl::Texture& shared() const { return layers_.shared(); }
  int layers() const { return layers_.layers(); }
  /// Level of the pyramid that is layer 0.
  int baseLevel() const { return baseLevel_; }

 private:
  MultiScaleSettings settings_;
  int baseLevel_;
  MultiScaleLayers layers_;
  std::string pass_;
};

}  // namespace limen::frame
