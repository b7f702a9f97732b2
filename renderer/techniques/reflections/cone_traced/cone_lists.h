// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "renderer/compute/prefix_sum.h"
#include "renderer/techniques/reflections/ray_hierarchy/pair_traversal.h"

namespace limen::techniques {

/// Of each tile of cones the triangles that they may meet: counted by the traversal, then scanned and
/// scattered.
class ConeLists {
 public:
  ConeLists(frame::Frame& frame, const PairTraversal& traversal);
  void make(const PairTraversal& traversal) const;
  /// Two numbers for each tile: its first triangle and how many, kConeUnlisted if it lacks some; then the
  /// triangles.
  const gl::Buffer& lists() const { return lists_; }
  int64_t bytes() const {
    return lists_.bytes() + sums_.bytes() + scan_.bytes() + (rounds_ ? rounds_->bytes() : 0);
  }
  /// Of the composition, in which each looks at the next kConeEntriesPerRound triangles of all lists; 1 on a
  /// GPU, which has no limit.
  uint32_t rounds() const { return roundCount_; }
  /// The indirect dispatches of all rounds; those that no list reaches have no groups. Only if there are more
  /// than one.
  const gl::Buffer& roundDispatches() const { return *rounds_; }

 private:
  uint32_t triangleCount_, roundCount_;
  glm::ivec2 sizePx_;
  const gl::Program& program_;
  compute::PrefixSum scan_;
  gl::Buffer sums_, lists_;
  std::optional<gl::Buffer> rounds_;
};

}  // namespace limen::techniques
