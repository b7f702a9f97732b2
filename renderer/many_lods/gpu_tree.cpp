// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/many_lods/gpu_tree.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <string>

#include "renderer/many_lods/many_lods_bindings.h"

namespace limen::many_lods {

GpuTree::GpuTree(gl::Context& context, const SphereTree& tree)
    : depth_(tree.depth),
      height_(tree.height()),
      leafRadius_(tree.leafRadius),
      levelFirst_(tree.levelFirst),
      nodes_(tree.spheres),
      cones_(tree.cones),
      samples_(tree.samples) {
  if (!tree.links.empty()) links_.emplace(tree.links);
  makePrograms(context, false);
}

void GpuTree::makePrograms(gl::Context& context, bool travel) {
  const std::string path =
      std::string("renderer/many_lods/") + (links_ ? "update_linked_tree" : "update_tree");
  for (const bool leaves : {false, true})
    for (const bool cones : {false, true}) {
      gl::ShaderDefines defines;
      if (leaves) defines["LEAVES"] = "1";
      if (cones) defines["CONES"] = "1";
      if (travel) defines["TRAVEL"] = "1";
      programs_[leaves][cones] = &context.programs().compute(path + ".comp.glsl", defines);
    }
}

void GpuTree::keepTravel(gl::Context& context, bool moves) {
  if (links_) return;
  travel_.emplace(std::vector<TreeTravel>(1));
  if (moves) makePrograms(context, true);
}

void GpuTree::update(const gl::Buffer& positions, const gl::Buffer& indices, bool cones) const {
  positions.bindStorage(kUpdatePositionsBuffer);
  indices.bindStorage(kUpdateIndicesBuffer);
  samples_.bindStorage(kUpdatePointsBuffer);
  nodes_.bindStorage(kUpdateNodesBuffer);
  cones_.bindStorage(kUpdateConesBuffer);
  if (travel_) travel_->bindStorage(kUpdateTravelBuffer);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  if (links_) {
    updateLinked(cones);
    return;
  }
  for (int level = depth_; level > 0; level -= kUpdateLevels) {
    const gl::Program& program = *programs_[level == depth_][cones];
    program.set("first", 1U << level);
    program.set("leafRadius", leafRadius_);
    program.use();
    glDispatchCompute(std::max((1U << level) / (2U * kUpdateGroup), 1U), 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  }
}

void GpuTree::updateLinked(bool cones) const {
  links_->bindStorage(kCutLinksBuffer);
  const gl::Program& program = *programs_[1][cones];
  program.set("leafRadius", leafRadius_);
  for (size_t level = levelFirst_.size() - 1; level > 0; --level) {
    const uint32_t first = levelFirst_[level - 1], end = levelFirst_[level];
    program.set("first", first);
    program.set("end", end);
    program.use();
    glDispatchCompute((end - first + kUpdateGroup - 1) / kUpdateGroup, 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  }
}

}  // namespace limen::many_lods
