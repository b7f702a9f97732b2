// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

#include "renderer/frame/frame.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/program.h"
#include "renderer/gl/texture.h"

namespace limen::techniques {

/// Data passed between the passes of a split search: search areas, levels, and the list of pixels that need
/// processing, which the GPU fills and dispatches over without the host knowing its length.
class SplitSearch {
 public:
  /// `smooths`, `orders`: room for smoothing levels, and for ordering the list. `lanes`: invocations per
  /// pixel of the passes over the list. `layers`: of the map; several have areas and levels each, and are not
  /// smoothed.
  SplitSearch(frame::Frame& frame, bool smooths, bool orders, int lanes, int layers);

  /// Goes on to an empty list and binds for the pass that fills it, which makeVisible() ends.
  void bindForClassify();
  /// For a pass over the list.
  void bindForGather() const;
  /// Both axes in turn, for the list's pixels; `program` is smooth_levels.comp.glsl with its other uniforms
  /// set.
  void smooth(const gl::Program& program) const;
  /// Makes the following passes process the list in order of loop length; the programs are the two forms of
  /// order_work.comp.glsl.
  void order(const gl::Program& count, const gl::Program& scatter) const;
  /// Runs `program`, whose groups have 64 invocations, over the list bound by bindForGather().
  void dispatchOverList(const gl::Program& program) const;
  /// Makes writes of the last pass visible to later ones.
  static void makeVisible();

  /// RGBA16UI: first texel and one past the last texel, of processed pixels only. Of the first layer.
  const gl::Texture& areas() const { return firstAreas_ ? *firstAreas_ : areas_; }
  /// Level in the first channel, of processed pixels; -1 for others if levels are smoothed or a layer has
  /// nothing to gather. R32F, or RG32F with the camera's depth. Of the first layer.
  const gl::Texture& levels() const { return firstLevels_ ? *firstLevels_ : levels_; }
  int64_t bytes() const;

 private:
  gl::Texture areas_, levels_;
  std::optional<gl::Texture> firstAreas_, firstLevels_;  // of several layers
  std::optional<gl::Texture> halfSmoothed_;
  /// Another list, in order, and its bins.
  struct Order {
    gl::Buffer list, bins, emptyBins;
  };
  const gl::Buffer& header() const { return headers_[current_]; }

  std::array<gl::Buffer, 2> headers_;  // of this list, and of the next one, which is empty
  size_t current_ = 0;
  gl::Buffer work_;
  std::optional<Order> order_;
};

}  // namespace limen::techniques
