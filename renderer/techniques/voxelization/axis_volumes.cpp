// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/voxelization/axis_volumes.h"

#include <epoxy/gl.h>

#include <array>

#include "renderer/techniques/voxelization/voxelization_bindings.h"

namespace limen::techniques {

AxisVolumes::AxisVolumes(frame::Frame& frame, const voxels::Volume& volume,
                         const std::vector<std::string>& stages, const gl::ShaderDefines& defines)
    : merge_(frame.context().programs().compute("renderer/techniques/voxelization/merge_axes.comp.glsl")) {
  std::vector<std::string> paths = {"renderer/techniques/voxelization/slice.vert.glsl"};
  paths.insert(paths.end(), stages.begin(), stages.end());
  const glm::ivec3 size = volume.grid().resolution;
  for (int axis = 0; axis < 3; ++axis) {
    gl::ShaderDefines own = defines;
    own["AXIS"] = std::to_string(axis);
    gl::Texture layers(gl::Format::R8, {size[(axis + 1) % 3], size[(axis + 2) % 3]}, 1, size[axis]);
    gl::Framebuffer framebuffer({&layers}, nullptr);
    axes_.push_back({&frame.context().programs().get(paths, own), std::move(layers), std::move(framebuffer)});
  }
}

void AxisVolumes::fill(frame::Frame& frame, const voxels::Volume& volume) const {
  constexpr std::array<float, 4> kEmpty = {0.0F, 0.0F, 0.0F, 0.0F};
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  for (const Axis& axis : axes_) {
    axis.framebuffer.bind();
    glClearBufferfv(GL_COLOR, 0, kEmpty.data());
    volume.configure(*axis.program);
    axis.program->use();
    frame.geometry().draw();
  }
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  axes_[0].layers.bindTexture(kAxisVolumeXUnit);
  axes_[1].layers.bindTexture(kAxisVolumeYUnit);
  axes_[2].layers.bindTexture(kAxisVolumeZUnit);
  volume.bits().bindImage(kMergedBitsImage, gl::Access::Write);
  volume.configure(merge_);
  merge_.use();
  const glm::ivec3 words(volume.bits().sizePx(), volume.grid().resolution.z);
  glDispatchCompute(static_cast<GLuint>(words.x), static_cast<GLuint>((words.y + 63) / 64),
                    static_cast<GLuint>(words.z));
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

int64_t AxisVolumes::bytes() const {
  int64_t sum = 0;
  for (const Axis& axis : axes_) sum += axis.layers.bytes();
  return sum;
}

}  // namespace limen::techniques
