// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/techniques/ray_casting/view_rays.h"
#include "renderer/techniques/tessellation/surface_picture.h"

namespace limen::techniques {

/// The picture of curved surfaces of which is known, by pixel, what is seen there: its material, normal and
/// distance. They are drawn into the picture of the scene's other parts.
class SeenPicture {
 public:
  /// `pass`: name of the technique's passes.
  SeenPicture(frame::Frame& frame, const frame::ShadedSetting& shading, const std::string& pass);
  ~SeenPicture();
  SeenPicture(const SeenPicture&) = delete;
  SeenPicture& operator=(const SeenPicture&) = delete;

  /// What was found on the CPU, of a scene's patches.
  void write(const scene::Scene& scene, const ExactView& seen);
  /// To be written by a shader: kSurfaceOfPatch and the material, 0 where nothing is seen; and unit normals
  /// towards the eye with distances along the view.
  const gl::Texture& ids() const { return ids_; }
  const gl::Texture& normals() const { return normals_; }

  void render(frame::Frame& frame);
  const gl::Texture& texture() const { return picture_.texture(); }

 private:
  SurfacePicture picture_;
  gl::Texture ids_, normals_;
  const gl::Program& program_;
  uint32_t vertexArray_ = 0;
};

}  // namespace limen::techniques
