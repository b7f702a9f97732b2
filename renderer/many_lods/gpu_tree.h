// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "renderer/gl/buffer.h"
#include "renderer/gl/context.h"
#include "renderer/many_lods/sphere_tree.h"

namespace limen::many_lods {

/// A tree of spheres in GPU memory: 16 bytes a node, and 8 for its cone.
class GpuTree {
 public:
  GpuTree(gl::Context& context, const SphereTree& tree);

  /// Spheres, and with `cones` cones, from where the vertices are: `positions` (three floats each, relative
  /// to the anchor) and `indices` as frame::GpuScene has them. One dispatch for each kUpdateLevels levels.
  /// The tree's topology stays. Binds storage buffers 0 to 4. Source: Holländer 2013, section 3.5.3.
  void update(const gl::Buffer& positions, const gl::Buffer& indices, bool cones = false) const;

  const gl::Buffer& nodes() const { return nodes_; }
  const gl::Buffer& cones() const { return cones_; }
  const gl::Buffer& samples() const { return samples_; }  ///< of the leaves: SurfaceSample
  int depth() const { return depth_; }
  float leafRadius() const { return leafRadius_; }
  int64_t bytes() const { return nodes_.bytes() + cones_.bytes() + samples_.bytes(); }

 private:
  int depth_;
  float leafRadius_;
  gl::Buffer nodes_, cones_, samples_;
  const gl::Program* programs_[2][2];  // [with leaves][with cones]
};

}  // namespace limen::many_lods
