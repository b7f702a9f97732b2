// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/base/enum_names.h"
#include "renderer/frame/frame.h"
#include "renderer/gl/buffer.h"
#include "renderer/ray_tracing/ray_tree.h"
#include "renderer/voxels/volume.h"
#include "renderer/voxels/voxel_lamps.h"

namespace limen::voxels {

/// Which voxels a triangle fills. Borders count as part of triangles and voxels.
enum class Coverage {
  Dominant,  ///< voxels in which it meets the middle line along the axis of its normal's largest component:
             ///< each triangle rasterised along one axis (Gaitatzes 2012, section 6.2)
  Thin,      ///< voxels in which it meets a middle line along any axis: the union of three rasterisations.
             ///< No path from face to face through empty voxels crosses the surface (Laine 2013)
  Conservative  ///< all voxels that it meets
};
constexpr EnumNames<Coverage, 3> enumNames(Coverage) {
  return {{{{Coverage::Dominant, "dominant"},
            {Coverage::Thin, "thin"},
            {Coverage::Conservative, "conservative"}}}};
}

/// Which of the scene's triangles enter.
struct TriangleSpan {
  uint32_t first = 0, end = 0xffffffffU;
};

/// Fills a volume with the finest triangles of a frame's scene, where its parts are at the frame's time: no
/// geometry shader, no cap, nothing to merge. Sums do not depend on the order of triangles. An attribute is
/// taken where the triangle meets a middle line, by Coverage::Conservative at its point nearest to the
/// voxel's middle. Triangles that are not finite are left out.
class Voxelizer {
 public:
  /// `queueCapacity`: parts of large triangles that are shared among all groups; beyond it an invocation
  /// takes them alone.
  Voxelizer(frame::Frame& frame, Coverage coverage, const Volume& into, const VoxelLamps& lamps = {},
            uint32_t queueCapacity = 65536);
  /// Empties the volume and fills it. Dispatches; nothing waits. Opens no pass. `tree`: that shadows are cast
  /// by; null: the one that the scene keeps, of its triangles at rest.
  void run(frame::Frame& frame, const Volume& into, const ray_tracing::RayTree* tree = nullptr) const;
  /// Fills without emptying, and without finishing the attributes.
  void add(frame::Frame& frame, const Volume& into, const ray_tracing::RayTree* tree = nullptr,
           TriangleSpan span = {}) const;

  /// Invocations so far whose rays were cut short by a software renderer's limit: not 0, light is wrong.
  /// Waits for the GPU.
  uint32_t cutShort() const;
  int64_t bytes() const { return queue_.bytes(); }

 private:
  void configure(const gl::Program& program, frame::Frame& frame, const Volume& into,
                 const ray_tracing::RayTree* tree) const;

  gl::Context& context_;
  VoxelLamps lamps_;
  uint32_t queueCapacity_;
  const gl::Program &alone_, &queued_;
  gl::Buffer queue_;
  mutable int turn_ = 0;
};

}  // namespace limen::voxels
