// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderer/frame/frame.h"
#include "renderer/frame/raster_regions.h"
#include "renderer/frame/shadow_map.h"
#include "renderer/gl/buffer.h"

namespace limen::frame {

/// What a region shows, and where: pixels outside [low, high) are not drawn.
struct RegionContent {
  scene::LodSelection selection;
  ivec2 low{0}, high{0};
  int64_t pixels() const { return int64_t{std::max(high.x - low.x, 0)} * std::max(high.y - low.y, 0); }
};

/// Draws several selections of a scene's levels into one view, each into a rectangle of its own in one
/// buffer: no more dispatches than for a single picture, and no work for pixels outside. Each pixel of a
/// region is a word, the bits of near / z as in ComputeRaster and ShadowRaster (0: nothing there); with
/// triangles it is two, the second the complement of the number of the triangle seen (0: none). The
/// rectangles' places are in a table of RasterRegion that the caller uploads.
///
/// With the driver's rasteriser each selection is drawn to a picture of its own and its rectangle copied, so
/// that the results are those of TriangleIds and ShadowDepth to the bit either way.
class RegionRaster {
 public:
  /// Of the parent's camera, with triangles; with `light`, a shadow map of `resolution` without. Shadow maps
  /// are rasterised as those of Shaded, or in compute if the parent's G-buffer is.
  RegionRaster(Frame& parent, const std::string& name, const LightFrustum* light = nullptr,
               int resolution = 0);
  ~RegionRaster();

  int wordsOfPixel() const { return light_ ? 1 : 2; }
  ivec2 sizePx() const { return sizePx_; }
  /// What draw() uploads of the regions: read by their shaders as ranges of triangles. `first`: number of the
  /// first region in the table.
  std::vector<glm::uvec4> rangesOf(const std::vector<RegionContent>& regions, int first) const;
  /// Where the ranges are in a buffer that the caller uploaded: the offset is a multiple of 256.
  struct Ranges {
    const gl::Buffer& buffer;
    int64_t offset = 0, count = 0;
    uint32_t triangles = 0;  ///< of all
  };
  /// `view`: time and camera. `table[first + i]` is where region i goes in `words`, which hold 0 there; the
  /// table is bound to kRasterRegionsBlock.
  void draw(Frame& view, const std::vector<RegionContent>& regions, const std::vector<RasterRegion>& table,
            int first, const Ranges& ranges, const gl::Buffer& words);
  int64_t bytes() const;

 private:
  struct Compute;
  struct Hardware;
  void drawByCompute(Frame& view, const Ranges& ranges, const gl::Buffer& words);
  void drawByHardware(Frame& view, const std::vector<RegionContent>& regions,
                      const std::vector<RasterRegion>& table, int first, const gl::Buffer& words);

  Frame& parent_;
  std::string name_;
  ivec2 sizePx_;
  std::optional<LightFrustum> light_;
  std::unique_ptr<Compute> compute_;
  std::unique_ptr<Hardware> hardware_;
};

}  // namespace limen::frame
