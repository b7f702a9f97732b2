// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
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
  /// Makes and binds the pyramid of a map, the layers above it and what occluders and biases are read from;
  /// returns the map's frustum. `map` is the index of the map among those combined.
  const frame::LightFrustum& bind(frame::Frame& frame, const frame::ShadowMapSettings& settings, size_t map);
  void configure(const gl::Program& program) const;

  /// The minimum/maximum pyramid, of which every structure needs the minimum for micro-occluders, and the
  /// layers above it, of all maps together; valid once they are bound.
  int64_t structureBytes() const;
  /// Memory stored only for the kind of occluders or form of bias.
  int64_t occluderBytes() const { return coarse_.bytes() + bias_.bytes(); }

 private:
  int64_t budget_;  // largest per pixel; 0: no limit
  int refinements_;
  StructureSettings structure_;
  OccluderChoice occluders_;
  std::optional<SearchCells> cells_;  // empty: levels
  CoarseOccluders coarse_;
  BiasForm bias_;
  int pyramidLevels_ = 0, baseLevel_ = 0, maxIterations_ = 0;
  std::vector<int64_t> structureBytes_;  // of each map
};

}  // namespace limen::techniques
