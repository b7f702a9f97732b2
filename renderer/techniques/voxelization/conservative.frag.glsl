// SPDX-License-Identifier: BSD-3-Clause
// A pixel that a triangle meets. What is drawn whole meets the voxel or not; attributes are taken at its nearest point.
#include "renderer/techniques/voxelization/slice_output.glsl"
#include "renderer/voxels/voxel_triangle.glsl"

void main() {
#if defined(SUMS) || !defined(CUT)
  VoxelTriangle t;
  loadTriangle(triangle, t);
  const ivec3 voxel = voxelOf(ivec2(gl_FragCoord.xy), gl_Layer, AXIS);
#ifndef CUT
  if (!meetsVoxel(t, voxel)) discard;
#endif
#ifdef SUMS
  point = nearestTo(t, vec3(voxel) + 0.5);
#endif
#endif
  writeFragment();
}
