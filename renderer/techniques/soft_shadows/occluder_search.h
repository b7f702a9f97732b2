// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "renderer/techniques/soft_shadows/bias_form.h"
#include "renderer/techniques/soft_shadows/coarse_occluders.h"
#include "renderer/techniques/soft_shadows/search_settings.h"

namespace limen::techniques {

/// Finds the texels of a shadow map that can matter for a receiver with an acceleration structure and
/// determines the micro-occluders made from them: the inputs and uniforms of occluder_search.glsl except
/// those of levels. The effect of a micro-occluder on the visibility is up to a Gathering. Source: Schwarz
/// 2009, sections 4.1 to 4.4.
class OccluderSearch {
 public:
  OccluderSearch(const SearchSettings& settings, const LevelSettings& levels,
                 const OccluderChoice& occluders);

  gl::ShaderDefines defines() const;
  /// Makes and binds the pyramids of the maps that a pass reads, the layers above them and what occluders and
  /// biases are read from; returns the frustum of the first. Several maps are layers of one (MAP_LAYERS).
  /// `index` is that of the first map among those combined.
  const frame::LightFrustum& bind(frame::Frame& frame, std::span<const frame::ShadowMapSettings> maps,
                                  size_t index);
  void configure(const gl::Program& program) const;

  /// The minimum/maximum pyramid, of which every structure needs the minimum for micro-occluders, and the
  /// layers above it, of all maps together; valid once they are bound.
  int64_t structureBytes() const;
  /// Memory stored only for the kind of occluders or form of bias.
  int64_t occluderBytes() const { return coarse_.bytes() + bias_.bytes(); }

 private:
  /// What is made of one map.
  struct Structures {
    const frame::MinMaxPyramid& pyramid;
    const frame::MultiScaleMap* layers;
    const frame::SampledPyramid* sampled;
    int64_t bytes() const;
  };
  Structures make(frame::Frame& frame, const frame::ShadowMapSettings& map);

  int64_t budget_;  // largest per pixel; 0: no limit
  int refinements_;
  StructureSettings structure_;
  OccluderChoice occluders_;
  std::optional<SearchCells> cells_;  // empty: levels
  CoarseOccluders coarse_;
  BiasForm bias_;
  int pyramidLevels_ = 0, baseLevel_ = 0, structureLayers_ = 0, maxIterations_ = 0;
  std::vector<frame::LightFrustum> frusta_;  // of the maps bound
  std::vector<int64_t> structureBytes_;      // of each map
};

}  // namespace limen::techniques
