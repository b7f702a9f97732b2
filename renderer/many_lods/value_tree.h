// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/gl/buffer.h"
#include "renderer/gl/context.h"
#include "renderer/many_lods/gpu_tree.h"

namespace limen::many_lods {

/// A value of four halves for each node of a tree, such as its light: given for leaves, each of which stands
/// for the same area, and averaged for the nodes above. Source: Holländer 2013, section 3.6.1 ("lit"
/// hierarchy); the mean is the bench's own reading.
class ValueTree {
 public:
  /// Of a complete tree.
  ValueTree(gl::Context& context, int depth);
  /// Of any tree, which must outlive this.
  ValueTree(gl::Context& context, const GpuTree& tree);
  /// uvec2 for each node: packHalf2x16 of the first and the last two. Leaf i of a complete tree is element
  /// 2^depth + i.
  const gl::Buffer& values() const { return values_; }
  /// From the leaves up. Binds storage buffer 0, and 6 of a tree that is not complete. Issues barriers for
  /// storage before and after.
  void average() const;

 private:
  void averageLinked() const;

  int depth_;
  const GpuTree* linked_ = nullptr;
  gl::Buffer values_;
  const gl::Program& program_;
};

}  // namespace limen::many_lods
