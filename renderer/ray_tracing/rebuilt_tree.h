// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "experiments/base/enum_names.h"
#include "renderer/compute/prefix_sum.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/context.h"
#include "renderer/gl/pass_list.h"
#include "renderer/ray_tracing/ray_tree.h"

namespace limen::ray_tracing {

/// A tree over triangles that the GPU builds, for vertices that move: triangles sorted by the Morton codes of
/// their centres (radix sort), the binary radix tree over the codes (Karras 2012, built bottom up with its
/// boxes as in Apetrei 2014), and from that the wide tree that RayScene has. Any triangles will do: those
/// without area or with a coordinate that is not finite are left out, equal codes are told apart by their
/// order. No more than kRayStack levels. Nothing waits for the GPU; the tree's shape depends on the triangles
/// alone, where its nodes lie in memory does not.
class RebuiltTree : public RayTree {
 public:
  static constexpr const char* kExtentPass = "ray_tracing/extent";
  static constexpr const char* kSortPass = "ray_tracing/sort";
  static constexpr const char* kMergePass = "ray_tracing/merge";
  static constexpr const char* kCollapsePass = "ray_tracing/collapse";

  /// For `triangles` triangles. `axisBits`: of a code for each axis, 10, 16 or 21. Throws Error if the device
  /// cannot hold the tree.
  RebuiltTree(gl::Context& context, uint32_t triangles, int axisBits = 16);

  /// Builds the tree. `positions`: three floats a vertex; `indices`: three words a triangle, of vertices that
  /// exist. Opens four passes. Storage buffers 0 to 7 are bound anew.
  void build(gl::PassList& passes, const gl::Buffer& positions, const gl::Buffer& indices) const;
  /// Boxes and wide nodes anew for moved vertices, the binary tree's shape as last built: the last two
  /// passes. Triangles that were left out stay so; those of the tree must still be finite.
  void refit(gl::PassList& passes, const gl::Buffer& positions, const gl::Buffer& indices) const;

  void bind(const gl::Program& program) const override;
  int64_t bytes() const override;

  /// Of the tree last built. Waits for the GPU.
  struct Counts {
    uint32_t triangles = 0;  ///< without those left out
    uint32_t nodes = 0;      ///< of the wide tree
    int levels = 0;
  };
  Counts counts() const;

 private:
  void sort(gl::PassList& passes, const gl::Buffer& positions, const gl::Buffer& indices) const;
  uint32_t tiles() const;

  uint32_t triangles_;
  int axisBits_, mostIterations_;
  compute::PrefixSum scan_;
  gl::Buffer control_, keys_, keysOther_, order_, orderOther_, counts_, sums_, nodes_, ranges_, tasks_,
      wideNodes_, wideTriangles_;
  const gl::Program *extent_, *codes_, *count_, *scatter_, *merge_, *alone_, *level_;
};

}  // namespace limen::ray_tracing
