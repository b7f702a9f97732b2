// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/many_lods/value_tree.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "renderer/many_lods/many_lods_bindings.h"

namespace limen::many_lods {

ValueTree::ValueTree(gl::Context& context, int depth)
    : depth_(depth),
      values_(int64_t{16} << depth, nullptr),
      program_(context.programs().compute("renderer/many_lods/average_tree.comp.glsl")) {}

ValueTree::ValueTree(gl::Context& context, const GpuTree& tree)
    : depth_(tree.depth()),
      linked_(tree.shape().links ? &tree : nullptr),
      values_(int64_t{16} << tree.depth(), nullptr),
      program_(context.programs().compute(linked_ ? "renderer/many_lods/average_linked_tree.comp.glsl"
                                                  : "renderer/many_lods/average_tree.comp.glsl")) {}

void ValueTree::averageLinked() const {
  linked_->shape().links->bindStorage(kCutLinksBuffer);
  const std::vector<uint32_t>& levels = linked_->levelFirst();
  for (size_t level = levels.size() - 1; level > 0; --level) {
    const uint32_t first = levels[level - 1], end = levels[level];
    program_.set("first", first);
    program_.set("end", end);
    program_.use();
    glDispatchCompute((end - first + kUpdateGroup - 1) / kUpdateGroup, 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  }
}

void ValueTree::average() const {
  values_.bindStorage(kAverageValuesBuffer);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  if (linked_) {
    averageLinked();
    return;
  }
  for (int level = depth_; level > 0; level -= kUpdateLevels) {
    program_.set("first", 1U << level);
    program_.use();
    glDispatchCompute(std::max((1U << level) / (2U * kUpdateGroup), 1U), 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  }
}

}  // namespace limen::many_lods
