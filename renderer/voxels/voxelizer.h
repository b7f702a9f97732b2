// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

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

/// Some of the scene's triangles.
struct TriangleSpan {
  uint32_t first = 0, end = 0xffffffffU;
};
/// What enters a volume.
struct VoxelizedPart {
  std::vector<TriangleSpan> spans = {{}};
  const ray_tracing::RayTree* tree = nullptr;  ///< that shadows are cast by; null: of the scene at rest
  const Volume* base = nullptr;  ///< all that is in it as well: filled by gather(), with the same grid
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
  /// Empties the volume and fills it. Dispatches; nothing waits. Opens no pass.
  void run(frame::Frame& frame, const Volume& into, const VoxelizedPart& part = {}) const;
  /// The same but for attachments, which are left to be made of the sums.
  void gather(frame::Frame& frame, const Volume& into, const VoxelizedPart& part = {}) const;

  /// Invocations so far whose rays were cut short by a software renderer's limit: not 0, light is wrong.
  /// Waits for the GPU.
  uint32_t cutShort() const;
  int64_t bytes() const { return queue_.bytes(); }

 private:
  struct Pass {
    const gl::Program *alone, *queued;
    bool sums;
  };
  Pass passFor(const gl::ShaderDefines& defines, bool sums) const;
  void configure(const gl::Program& program, const Pass& pass, frame::Frame& frame, const Volume& into,
                 const ray_tracing::RayTree* tree) const;
  void run(const Pass& pass, frame::Frame& frame, const Volume& into, const VoxelizedPart& part) const;

  gl::Context& context_;
  VoxelLamps lamps_;
  uint32_t queueCapacity_;
  std::optional<Pass> bits_, sums_;  // the second sets bits as well, if there is no first
  gl::Buffer queue_;
  mutable int turn_ = 0;
};

/// Voxels of a grid that a frame's scene occupies. For preparation: allocates, and waits for the GPU.
int64_t countOccupied(frame::Frame& frame, const VoxelGrid& grid, Coverage coverage);

}  // namespace limen::voxels
