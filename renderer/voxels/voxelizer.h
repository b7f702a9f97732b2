// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/base/enum_names.h"
#include "renderer/frame/frame.h"
#include "renderer/voxels/volume.h"

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

/// Fills a volume with the finest triangles of a frame's scene, where its parts are at the frame's time, in
/// one dispatch: no geometry shader, no cap, nothing to merge. Attributes are means over entries; a triangle
/// enters a voxel once, by Coverage::Thin once for each axis. Triangles that are not finite are left out. An
/// albedo is the material's, without its pattern.
class Voxelizer {
 public:
  Voxelizer(gl::Context& context, Coverage coverage, const Volume& into);
  /// Empties the volume and fills it. Dispatches; nothing waits. Opens no pass.
  void run(const frame::Frame& frame, const Volume& into) const;
  /// Fills without emptying, and without finishing the attributes.
  void add(const frame::Frame& frame, const Volume& into) const;

 private:
  const gl::Program& program_;
};

}  // namespace limen::voxels
