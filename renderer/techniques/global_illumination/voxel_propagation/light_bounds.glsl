// SPDX-License-Identifier: BSD-3-Clause
// Light that leaves the scene's box is lost: empty voxels beyond it, as before a room's open front, hold none.
#include "renderer/voxels/volume.glsl"

uniform vec3 boundsLow, boundsHigh;  // of the scene, in voxels

bool isOpen(ivec3 voxel) {
  const vec3 middle = vec3(voxel) + 0.5;
  return isInGrid(voxel) && !isOccupied(voxel) && all(greaterThanEqual(middle, boundsLow)) &&
         all(lessThanEqual(middle, boundsHigh));
}
