// SPDX-License-Identifier: BSD-3-Clause
// Words of light_cells.glsl, made once for all steps of a frame.
#include "renderer/techniques/global_illumination/voxel_propagation/light_bounds.glsl"
#include "renderer/techniques/global_illumination/illumination_bindings.h"

layout(local_size_x = kPropagateGroup, local_size_y = kPropagateGroup, local_size_z = kPropagateGroup) in;
layout(binding = kLightCellsImage, r32ui) uniform writeonly uimage2DArray cells;

// Voxels that may hold light: open ones, and surfaces that let some through.
bool mayHoldLight(ivec3 voxel) { return isOccupied(voxel) ? texelFetch(volumeNormal, voxel, 0).w < 1.0 : isOpen(voxel); }

void main() {
  const ivec3 voxel = ivec3(gl_GlobalInvocationID);
  if (!isInGrid(voxel)) return;
  uint cell = (isOccupied(voxel) ? 1u << kCellSurface : 0u) | (mayHoldLight(voxel) ? 1u << kCellLight : 0u);
  // The mean of unit normals within some 11 degrees of each other is longer.
  if (isOccupied(voxel) && length(texelFetch(volumeNormal, voxel, 0).xyz) < 0.98) cell |= 1u << kCellEdge;
  for (int face = 0; face < 6; ++face) {
    const int axis = face >> 1;
    const ivec3 beside = voxel + ((face & 1) == 0 ? 1 : -1) * ivec3(axis == 0, axis == 1, axis == 2);
    if (isOccupied(beside)) cell |= 1u << (kCellBesideSurface + face);
    if (mayHoldLight(beside) && takesFrom(voxel, beside)) cell |= 1u << (kCellBesideLight + face);
  }
  imageStore(cells, voxel, uvec4(cell));
}
