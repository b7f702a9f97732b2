// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "renderer/frame/shaded.h"
#include "renderer/techniques/reflections/environment_map/cube_map.h"
#include "renderer/techniques/reflections/view_raster.h"

namespace limen::techniques {

/// What the middle of the scene's largest mirror sees but for that mirror, as a cube map: light in rgb, in
/// alpha the distance, 0 where nothing is seen (Roger 2008, section 1.3.2). A second layer, if wanted, holds
/// the nearest front faces behind the first.
class Surroundings {
 public:
  /// `resolution`: texels along a face's side; `layers`: 1 or 2. Compiles and allocates.
  Surroundings(frame::Frame& frame, int resolution, bool mipLevels, const frame::ShadedSetting& shading,
               int layers = 1);
  /// Draws all faces and makes the levels above them.
  void draw(frame::Frame& frame);

  const CubeMap& map() const { return first_->map; }
  const CubeMap* secondLayer() const { return second_ ? &second_->map : nullptr; }
  glm::dvec3 middle() const { return middle_; }  ///< relative to the scene's anchor
  int64_t bytes() const;

 private:
  struct Layer {
    Layer(frame::Frame& frame, int resolution, const std::vector<uint32_t>& partOf, ViewRaster::Shown shown,
          bool mipLevels)
        : raster(frame, glm::ivec2(resolution), partOf, false, shown), map(resolution, mipLevels) {}
    ViewRaster raster;
    CubeMap map;
  };
  void drawFace(frame::Frame& frame, int face);
  void shadeFace(frame::Frame& frame, const Layer& layer, int face);

  frame::ShadedSetting shading_;
  uint32_t part_ = ViewRaster::kNoGroup;
  glm::dvec3 middle_{0.0};
  std::optional<Layer> first_, second_;
  const gl::Program* program_;
};

}  // namespace limen::techniques
