// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/many_lods/value_tree.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "renderer/many_lods/many_lods_bindings.h"

namespace limen::many_lods {

ValueTree::ValueTree(gl::Context& context, int depth)
    : depth_(depth),
      values_(int64_t{16} << depth, nullptr),
      program_(context.programs().compute("renderer/many_lods/average_tree.comp.glsl")) {}

void ValueTree::average() const {
  values_.bindStorage(kAverageValuesBuffer);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  for (int level = depth_; level > 0; level -= kUpdateLevels) {
    program_.set("first", 1U << level);
    program_.use();
    glDispatchCompute(std::max((1U << level) / (2U * kUpdateGroup), 1U), 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  }
}

}  // namespace limen::many_lods
