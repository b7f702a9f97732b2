// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "renderer/gl/buffer.h"
#include "renderer/gl/context.h"
#include "renderer/many_lods/view_atlas.h"

namespace limen::many_lods {

/// Imperfect shadow maps: each view draws a fixed number of leaves, at random, the same ones in every frame,
/// and holes between them are closed from coarser levels of the tile. Source: Ritschel and others 2008;
/// Holländer 2013, section 3.5.1 (8,000 points).
class FixedPoints {
 public:
  /// `tilePx`: a power of two, 64 at most. Throws Error if the device cannot hold the list.
  FixedPoints(gl::Context& context, uint32_t views, uint32_t perView, int depth, int tilePx, uint32_t seed);

  DrawList drawList() const { return {list_, control_}; }
  /// Of the discs over spheres of leaves, so that they cover the surface as those of all leaves would.
  float radiusScale() const { return radiusScale_; }
  /// Pulls `levels` levels of means up, 0 to 6, and pushes them down into empty pixels. Depths farther than
  /// the nearest of four by the share `tolerance` are left out of means.
  void fill(const ViewAtlas& atlas, int levels, float tolerance) const;
  int64_t bytes() const { return list_.bytes() + control_.bytes(); }

 private:
  uint32_t views_;
  float radiusScale_;
  gl::Buffer list_, control_;
  const gl::Program& fill_;
};

}  // namespace limen::many_lods
