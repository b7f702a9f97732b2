// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/scene/scene.h"
#include "renderer/voxels/voxel_grid.h"

namespace limen::techniques {

/// Grid of `resolution` voxels along the longest side of a scene's box for light in its empty voxels: it is
/// wider than the box by .95 of a voxel, so that walls along the box lie just within their voxels' inner
/// faces, and the empty voxels of a room have the room's size. Sides are multiples of `multiple`.
voxels::VoxelGrid lightBox(const scene::Scene& scene, int resolution, int multiple = 1);

}  // namespace limen::techniques
