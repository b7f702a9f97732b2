// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "renderer/frame/shaded.h"
#include "renderer/techniques/reflections/environment_map/cube_map.h"
#include "renderer/techniques/reflections/view_raster.h"

namespace limen::techniques {

/// What the middle of the scene's largest mirror sees but for that mirror, as a cube map: light in rgb, in
/// alpha the distance, 0 where nothing is seen (Roger 2008, section 1.3.2).
class Surroundings {
 public:
  /// `resolution`: texels along a face's side. Compiles and allocates.
  Surroundings(frame::Frame& frame, int resolution, bool mipLevels, const frame::ShadedSetting& shading);
  /// Draws all faces and makes the levels above them.
  void draw(frame::Frame& frame);

  const CubeMap& map() const { return map_; }
  glm::dvec3 middle() const { return middle_; }  ///< relative to the scene's anchor
  int64_t bytes() const { return map_.bytes() + raster_->bytes(); }

 private:
  void drawFace(frame::Frame& frame, int face);

  frame::ShadedSetting shading_;
  uint32_t part_ = ViewRaster::kNoGroup;
  glm::dvec3 middle_{0.0};
  CubeMap map_;
  std::optional<ViewRaster> raster_;
  const gl::Program* program_;
};

}  // namespace limen::techniques
