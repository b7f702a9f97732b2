// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "renderer/frame/frame.h"
#include "renderer/ray_tracing/rebuilt_tree.h"

namespace limen::techniques {

/// What rays meet in a scene whose parts move: a tree of where they are in each frame.
class MovedRays {
 public:
  explicit MovedRays(frame::Frame& frame);

  /// Builds the frame's tree, in passes of its own; nothing where all parts rest. Storage buffers are bound
  /// anew.
  void build(frame::Frame& frame) const;
  /// Null: the one that the scene keeps.
  const ray_tracing::RayTree* tree() const { return tree_ ? &*tree_ : nullptr; }
  int64_t bytes() const { return tree_ ? tree_->bytes() : 0; }

 private:
  std::optional<ray_tracing::RebuiltTree> tree_;
};

}  // namespace limen::techniques
