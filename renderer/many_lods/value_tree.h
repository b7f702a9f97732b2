// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/gl/buffer.h"
#include "renderer/gl/context.h"

namespace limen::many_lods {

/// A value of four halves for each node of a tree, such as its light: given for leaves, each of which stands
/// for the same area, and averaged for the nodes above. Source: Holländer 2013, section 3.6.1 ("lit"
/// hierarchy); the mean is the bench's own reading.
class ValueTree {
 public:
  ValueTree(gl::Context& context, int depth);
  /// uvec2 for each node: packHalf2x16 of the first and the last two. Leaf i is element 2^depth + i.
  const gl::Buffer& values() const { return values_; }
  /// From the leaves up. Binds storage buffer 0. Issues barriers for storage before and after.
  void average() const;

 private:
  int depth_;
  gl::Buffer values_;
  const gl::Program& program_;
};

}  // namespace limen::many_lods
