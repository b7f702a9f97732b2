// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "renderer/gl/buffer.h"
#include "renderer/gl/context.h"
#include "renderer/many_lods/cut_finder.h"
#include "renderer/many_lods/cut_mode.h"
#include "renderer/many_lods/many_lods_bindings.h"
#include "renderer/many_lods/recursive_cut.h"
#include "renderer/many_lods/tree_shape.h"

namespace limen::many_lods {

/// The cuts of one tree for many views, made on the GPU (ManyLoDs). The list has an entry (node, view) for
/// each node of each cut, what is culled included; CutOrder says in which order.
///
/// Basic and incremental cuts are those of the recursion from the root, as children of valid nodes are valid
/// (node_predicate.h): an entry with a valid parent climbs as long as it is a first child, and is dropped
/// where it is another one. Lazy cuts merge where all children are there; every cut covers each leaf once
/// in every frame. Splits that the list has no room for are not done, and counted. Source: Holländer 2013,
/// sections 3.5.2 and 3.5.3; exact merge and budget are the bench's own.
class MultiCut {
 public:
  /// `capacity`: of the list, entries, >= views. Throws Error if the device cannot hold it, or the mode has
  /// no form for such a tree.
  MultiCut(gl::Context& context, uint32_t views, const TreeShape& shape, uint32_t capacity,
           const CutMode& mode);
  /// Of a complete binary tree.
  MultiCut(gl::Context& context, uint32_t views, int depth, uint32_t capacity, const CutMode& mode)
      : MultiCut(context, views, TreeShape{.height = depth}, capacity, mode) {}

  /// The cuts for `nodes` (spheres of a tree) and `views` (CutView each). Binds storage buffers 0 to 6. Ends
  /// with a barrier for storage and commands. `counting`: counts tests and merges as well.
  void update(const gl::Buffer& nodes, const gl::Buffer& views, bool counting = false) {
    finder_->update(nodes, views, counting);
  }
  /// The next update starts from the root.
  void restart() { finder_->restart(); }

  const gl::Buffer& listBuffer() const { return finder_->list(); }
  const gl::Buffer& controlBuffer() const { return finder_->control(); }  ///< CutControl first
  int64_t bytes() const { return finder_->bytes(); }
  uint32_t capacity() const { return capacity_; }
  uint32_t viewCount() const { return views_; }

  /// Wait for the GPU.
  CutControl control() const;
  std::vector<glm::uvec2> list() const;  ///< node, view

 private:
  uint32_t views_, capacity_;
  std::unique_ptr<CutFinder> finder_;
};

}  // namespace limen::many_lods
