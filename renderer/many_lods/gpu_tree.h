// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "renderer/gl/buffer.h"
#include "renderer/gl/context.h"
#include "renderer/many_lods/sphere_tree.h"
#include "renderer/many_lods/tree_shape.h"

namespace limen::many_lods {

/// A tree of spheres in GPU memory: 16 bytes a node, and 8 for its cone.
class GpuTree {
 public:
  GpuTree(gl::Context& context, const SphereTree& tree);

  /// Spheres, and with `cones` cones, from where the vertices are: `positions` (three floats each, relative
  /// to the anchor) and `indices` as frame::GpuScene has them. One dispatch for each kUpdateLevels levels, or
  /// of a tree that is not complete for each level.
  /// The tree's topology stays. Binds storage buffers 0 to 4. Source: Holländer 2013, section 3.5.3.
  void update(const gl::Buffer& positions, const gl::Buffer& indices, bool cones = false) const;

  /// From now on update() keeps account of how far nodes travel, where `moves`; else they are known to stay
  /// where they are, and do. Nothing is kept of a tree that is not complete.
  void keepTravel(gl::Context& context, bool moves);

  const gl::Buffer& nodes() const { return nodes_; }
  const gl::Buffer& cones() const { return cones_; }
  /// Of the leaves: SurfaceSample; of a tree that is not complete for each node, kNoTriangle in inner ones.
  const gl::Buffer& samples() const { return samples_; }
  int depth() const { return depth_; }
  /// For those who walk it.
  TreeShape shape() const { return {height_, links_ ? &*links_ : nullptr, travel_ ? &*travel_ : nullptr}; }
  /// Of a tree that is not complete: first node of each level, then the number of nodes' places.
  const std::vector<uint32_t>& levelFirst() const { return levelFirst_; }
  float leafRadius() const { return leafRadius_; }
  int64_t bytes() const {
    return nodes_.bytes() + cones_.bytes() + samples_.bytes() + (links_ ? links_->bytes() : 0);
  }

 private:
  void updateLinked(bool cones) const;
  void makePrograms(gl::Context& context, bool travel);

  int depth_, height_;
  float leafRadius_;
  std::vector<uint32_t> levelFirst_;
  gl::Buffer nodes_, cones_, samples_;
  std::optional<gl::Buffer> links_, travel_;
  const gl::Program* programs_[2][2];  // [with leaves][with cones]; linked: [1]
};

}  // namespace limen::many_lods
