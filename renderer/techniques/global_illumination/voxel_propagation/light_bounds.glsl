// SPDX-License-Identifier: BSD-3-Clause
// Light that leaves the box of the scene is lost but for its margin, where it goes on along the box to surfaces that face outwards, and
// comes back into no empty voxel of the scene: it would go around walls that end at the box. Beyond, no voxel holds any.
#include "renderer/voxels/volume.glsl"

uniform vec3 boundsLow, boundsHigh;  // of the scene, in voxels
uniform float margin;                // voxels

bool isWithin(ivec3 voxel, float beyond) {
  const vec3 middle = vec3(voxel) + 0.5;
  return all(greaterThanEqual(middle, boundsLow - beyond)) && all(lessThanEqual(middle, boundsHigh + beyond));
}

bool isOpen(ivec3 voxel) { return isInGrid(voxel) && !isOccupied(voxel) && isWithin(voxel, margin); }

// Whether light may come from a voxel that holds some.
bool takesFrom(ivec3 voxel, ivec3 beside) { return isOccupied(voxel) || !isWithin(voxel, 0.0) || isWithin(beside, 0.0); }
