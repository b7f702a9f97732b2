// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "experiments/base/enum_names.h"
#include "renderer/frame/frame.h"
#include "renderer/frame/shadow_map.h"
#include "renderer/gl/program.h"
#include "renderer/gl/texture.h"
#include "renderer/voxels/voxel_grid.h"

namespace limen::incremental_voxels {

/// A depth image that knows the triangle of each pixel.
struct DepthView {
  /// Of positions relative to the anchor: z along the view, x to the right and y down in the image.
  glm::dmat4 fromAnchor{1.0};
  glm::dvec2 low{-1.0}, high{1.0};  ///< tangents x / z and y / z at the image's corners
  double near = 1e-3;               ///< z of the near plane; a depth is near / z, 0: nothing is seen
  glm::ivec2 sizePx{1};
  const gl::Texture *depth = nullptr, *triangles = nullptr;
};

/// What a frame's camera sees. Asks the frame for its triangles.
DepthView cameraView(frame::Frame& frame);

/// Depth image from the middle of a scene's first light, fitted to a box.
class LightMap {
 public:
  LightMap(gl::Context& context, int resolution, frame::Raster raster);
  /// Of the light of the frame's scene. Opens no pass. `box`: world space.
  void draw(frame::Frame& frame, const scene::Bounds& box);
  const DepthView& view() const { return view_; }
  int64_t bytes() const { return raster_.bytes(); }

 private:
  int resolution_;
  frame::ShadowRaster raster_;
  DepthView view_;
};

/// Smallest frustum of a light that holds what of a box is before it, at most 75 degrees off its direction.
frame::LightFrustum fitted(const scene::AreaLight& light, const scene::Bounds& box);

/// Views as shaders see them that include depth_views.glsl: textures, and uniforms in the grid's voxels. The
/// program is compiled with VIEWS, their number.
void configureViews(const gl::Program& program, const std::vector<DepthView>& views,
                    const voxels::VoxelGrid& grid, glm::dvec3 anchor);

}  // namespace limen::incremental_voxels
