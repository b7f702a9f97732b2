// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "renderer/frame/frame.h"
#include "renderer/gl/buffer.h"
#include "renderer/ray_tracing/ray_tree.h"
#include "renderer/ray_tracing/rebuilt_tree.h"

namespace limen::techniques {

/// A tree over some of the scene's triangles, numbered as in the scene; if any of them move it is built anew
/// in each frame.
class TracedTriangles {
 public:
  /// `triangles`: of the scene, those left out without area.
  TracedTriangles(frame::Frame& frame, const std::vector<glm::uvec3>& triangles);

  /// Before a pass is opened, in each frame.
  void update(frame::Frame& frame) const;
  const ray_tracing::RayTree& tree() const { return *tree_; }
  /// But for those of a tree that is built anew, which the passes that build it hold.
  int64_t bytes() const { return rebuilt_ ? indices_->bytes() : tree_->bytes(); }

 private:
  std::unique_ptr<ray_tracing::RayTree> tree_;
  const ray_tracing::RebuiltTree* rebuilt_ = nullptr;  ///< `tree_`, if triangles move
  std::optional<gl::Buffer> indices_;                  ///< of the triangles, for it
};

/// Positions of the scene's vertices at rest, relative to its anchor.
std::vector<glm::vec3> anchoredVertices(const frame::Frame& frame);

}  // namespace limen::techniques
