// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/frame/frame.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/program.h"
#include "renderer/many_lods/view_atlas.h"

namespace limen::techniques {

/// Depths of all triangles of a scene in the tiles of views: what cuts approximate. Every view draws every
/// triangle, from both sides; a pixel has the depth that its middle sees. Edges are planes through the eye,
/// so that triangles have their true outlines in hemispheres too, where edges are arcs. In compute, as a
/// layered raster pass would neither project edges so nor be faster (docs/gpu.md). Source: Holländer 2013,
/// section 3.6.2 ("polygons" of table 3.1).
class PolygonTiles {
 public:
  explicit PolygonTiles(frame::Frame& frame);
  /// Clears `atlas` (AtlasForm::Depth) and draws.
  void draw(frame::Frame& frame, const gl::Buffer& views, uint32_t viewCount,
            const many_lods::ViewAtlas& atlas) const;

 private:
  const gl::Program& program_;
  uint32_t triangles_;
};

}  // namespace limen::techniques
