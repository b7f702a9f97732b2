// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "renderer/techniques/technique.h"
#include "renderer/voxels/volume.h"

namespace limen::techniques {

/// Three volumes, one for each axis along which a geometry shader sends slices of triangles to layers, and
/// their union (Gaitatzes 2012, section 6.2). A triangle is in the volume of the axis of its normal's largest
/// component.
class AxisVolumes {
 public:
  /// The stages after slice.vert.glsl, which are compiled with AXIS = 0, 1 and 2.
  AxisVolumes(frame::Frame& frame, const voxels::Volume& volume, const std::vector<std::string>& stages,
              const gl::ShaderDefines& defines);
  void fill(frame::Frame& frame, const voxels::Volume& volume) const;
  int64_t bytes() const;

 private:
  struct Axis {
    const gl::Program* program;
    gl::Texture layers;  // R8: x and y are the next two axes in cyclic order
    gl::Framebuffer framebuffer;
  };
  std::vector<Axis> axes_;
  const gl::Program& merge_;
};

}  // namespace limen::techniques
