// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "experiments/base/enum_names.h"
#include "renderer/frame/shadow_map.h"

namespace limen::frame {

/// The depth difference by which a microrect prefers one neighbour to another. Schwarz 2009, section 4.5.2,
/// uses the absolute one; relative to the nearer depth, the preference does not change with the scene's
/// distance.
enum class MergeMetric { Absolute, Relative };
constexpr EnumNames<MergeMetric, 2> enumNames(MergeMetric) {
  return {{{{MergeMetric::Absolute, "absolute"}, {MergeMetric::Relative, "relative"}}}};
}

/// What happens to a microrect that is dropped on both axes and thus lies between four that are kept.
enum class DiagonalMerge {
  /// Merged into the one at its lower left if that spans it already, otherwise into the one at its upper
  /// right, whatever their depths (Schwarz 2009, section 4.5.2).
  Contained,
  /// Merged into the one that differs least from it in depth; not in the thesis. The first rule merges single
  /// texels of a diagonal silhouette into a microrect of the background, all of which then comes forward.
  Nearest
};
constexpr EnumNames<DiagonalMerge, 2> enumNames(DiagonalMerge) {
  return {{{{DiagonalMerge::Contained, "contained"}, {DiagonalMerge::Nearest, "nearest"}}}};
}

struct MergeRule {
  MergeMetric metric = MergeMetric::Absolute;
  DiagonalMerge diagonal = DiagonalMerge::Contained;
};

/// Microrects of the levels above the shadow map: rectangles of level-0 texels, one for each texel of a
/// level, of variable size and position. Source: Schwarz 2009, sections 4.5.1 and 4.5.2.
///
/// Microrect (x, y) of level i has its reference texel at (x, y) 2^i. It reaches from there by k_- texels
/// down and k_+ up on either axis, each at most 2^i - 1, so that it holds its own reference texel and no
/// other one of the level. At level 0 microrects are the texels: nothing is stored for it, and level i is
/// level i - 1 of the textures. A map of one texel has no other level.
///
/// The thesis states two passes per level and leaves open what happens to a diagonal neighbour in the last
/// row or column, to whose upper right nothing is kept: here it is merged as along an axis, with whichever of
/// its two kept neighbours is closer in depth.
class MicrorectLevels {
 public:
  /// The map's resolution is a power of two; `first` as for MapTexture.
  MicrorectLevels(gl::Context& context, const ShadowMapSettings& map, MergeRule rule,
                  const MicrorectLevels* first = nullptr);
  /// From level 0 of `minimum`, R32F and of the map's resolution.
  void build(const gl::Texture& minimum) const;
  /// R32F: smallest depth of what a microrect was merged from.
  const gl::Texture& depths() const { return depths_.own(); }
  /// RGBA16UI: k_-x, k_-y, k_+x, k_+y in texels of level 0.
  const gl::Texture& extents() const { return extents_.own(); }
  const gl::Texture& sharedDepths() const { return depths_.shared(); }  ///< as for MapTexture
  const gl::Texture& sharedExtents() const { return extents_.shared(); }
  /// Levels that are stored; the textures of a map of one texel have one that is never written.
  int levels() const { return levels_; }
  /// 12 bytes per microrect, plus 8 for each of level 1 during construction: 6 MiB for a map of 1024 x 1024.
  int64_t bytes() const { return depths().bytes() + extents().bytes() + merged_.bytes(); }

 private:
  int resolution_, levels_;
  const gl::Program &first_, &second_;
  MapTexture depths_, extents_;
  gl::Texture merged_;
};

struct MicrorectSettings {
  ShadowMapSettings map;
  MergeRule rule{};
  std::string key() const {
    return map.key() + (rule.metric == MergeMetric::Relative ? "/relative" : "/absolute") +
           (rule.diagonal == DiagonalMerge::Nearest ? "/nearest" : "/contained");
  }
};

/// Microrects of the shadow map, in their own pass.
class MicrorectMap : public FrameInput {
 public:
  static constexpr const char* kName = "microrect_map";
  MicrorectMap(Frame& frame, MicrorectSettings settings);
  void make(Frame& frame) override;
  const MicrorectLevels& levels() const { return levels_; }

 private:
  MicrorectSettings settings_;
  MicrorectLevels levels_;
  std::string pass_;
};

}  // namespace limen::frame
