// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/many_lods/gpu_tree.h"

#include <epoxy/gl.h>

#include <algorithm>

namespace limen::many_lods {

GpuTree::GpuTree(gl::Context& context, const SphereTree& tree)
    : depth_(tree.depth),
      leafRadius_(tree.leafRadius),
      nodes_(tree.spheres),
      cones_(tree.cones),
      samples_(tree.samples) {
  for (const bool leaves : {false, true})
    for (const bool cones : {false, true}) {
      gl::ShaderDefines defines;
      if (leaves) defines["LEAVES"] = "1";
      if (cones) defines["CONES"] = "1";
      programs_[leaves][cones] =
          &context.programs().compute("renderer/many_lods/update_tree.comp.glsl", defines);
    }
}

void GpuTree::update(const gl::Buffer& positions, const gl::Buffer& indices, bool cones) const {
  positions.bindStorage(kUpdatePositionsBuffer);
  indices.bindStorage(kUpdateIndicesBuffer);
  samples_.bindStorage(kUpdatePointsBuffer);
  nodes_.bindStorage(kUpdateNodesBuffer);
  cones_.bindStorage(kUpdateConesBuffer);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  for (int level = depth_; level > 0; level -= kUpdateLevels) {
    const gl::Program& program = *programs_[level == depth_][cones];
    program.set("first", 1U << level);
    program.set("leafRadius", leafRadius_);
    program.use();
    glDispatchCompute(std::max((1U << level) / (2U * kUpdateGroup), 1U), 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  }
}

}  // namespace limen::many_lods
